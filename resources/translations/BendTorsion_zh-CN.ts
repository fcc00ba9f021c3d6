<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="zh_CN" sourcelanguage="en">
<context>
    <name>App::Property</name>
    <message>
        <source>A Surface, or a face of any object, for cut by surface</source>
        <translation>按曲面切割时：一个曲面对象，或任一对象的面</translation>
    </message>
    <message>
        <source>A curve of the surface instead of points</source>
        <translation>用曲面上的曲线代替点</translation>
    </message>
    <message>
        <source>A picked curve, wire or shape</source>
        <translation>所选的曲线、线框或形体</translation>
    </message>
    <message>
        <source>A point near the axis, mm</source>
        <translation>轴线附近的一点，mm</translation>
    </message>
    <message>
        <source>A point of the plane (plane section), mm</source>
        <translation>平面上的一点（平面截交），mm</translation>
    </message>
    <message>
        <source>A point of the plane, mm</source>
        <translation>平面上的一点，mm</translation>
    </message>
    <message>
        <source>A pulled axis leaves the surface by no more than this</source>
        <translation>拉到曲面上的轴线离开曲面不超过此值</translation>
    </message>
    <message>
        <source>About where on the member that runs through; matters where the two meet twice</source>
        <translation>在贯通构件上的大致位置；两构件相交两次时才需要</translation>
    </message>
    <message>
        <source>Added per butt joint, half to each of its plates, mm</source>
        <translation>每条对接缝的加量，两侧板各一半，mm</translation>
    </message>
    <message>
        <source>Added per diaphragm within a plate, mm</source>
        <translation>板件范围内每块隔板的加量，mm</translation>
    </message>
    <message>
        <source>Align to the axis, to the previous segment, or hold the top or bottom face at the offset from the surface itself</source>
        <translation>对齐到轴线、前一段，或使顶面或底面与曲面本身保持偏移距离</translation>
    </message>
    <message>
        <source>Allowances</source>
        <translation>加量</translation>
    </message>
    <message>
        <source>Angle between the axes</source>
        <translation>两轴线的夹角</translation>
    </message>
    <message>
        <source>Angle from y to the axis of the largest second moment</source>
        <translation>由 y 到最大惯性矩主轴的角度</translation>
    </message>
    <message>
        <source>Area of each pattern with its allowances, as cut, mm2</source>
        <translation>各展开图含加量的下料面积，mm2</translation>
    </message>
    <message>
        <source>Area of the member seen from outside, ends apart</source>
        <translation>构件外露面积，不含端面</translation>
    </message>
    <message>
        <source>Area of the plates</source>
        <translation>板件面积</translation>
    </message>
    <message>
        <source>Area seen from outside, ends apart</source>
        <translation>外露面积，不含端面</translation>
    </message>
    <message>
        <source>Axes whose crossings with this one are wanted as control points</source>
        <translation>要求以其与本轴线的交点作为控制点的轴线</translation>
    </message>
    <message>
        <source>Axis</source>
        <translation>轴线</translation>
    </message>
    <message>
        <source>Bed</source>
        <translation>胎架</translation>
    </message>
    <message>
        <source>Breadth of the bottom flange (i) or bottom (trapezoid); 0 for Breadth</source>
        <translation>下翼缘（i）或底边（梯形）的宽度；0 表示同 Breadth</translation>
    </message>
    <message>
        <source>Breadth over the outer faces; of the top where the bottom has its own</source>
        <translation>外表面之间的宽度；底边另有宽度时为顶边宽度</translation>
    </message>
    <message>
        <source>Bring the end to the height EndZ</source>
        <translation>将终端移到标高 EndZ</translation>
    </message>
    <message>
        <source>Bring the start to the height StartZ</source>
        <translation>将始端移到标高 StartZ</translation>
    </message>
    <message>
        <source>Camber or erection preset: displacement in x, y, z, mm, one per place</source>
        <translation>预拱或安装预调：每处在 x、y、z 的位移，mm</translation>
    </message>
    <message>
        <source>Camber or erection preset: places, ratios up to 1 or mm</source>
        <translation>预拱或安装预调：位置，不大于 1 的比例或 mm</translation>
    </message>
    <message>
        <source>Centre of gravity of all plates, mm</source>
        <translation>全部板件的重心，mm</translation>
    </message>
    <message>
        <source>Centre of gravity of each piece, mm</source>
        <translation>各单元的重心，mm</translation>
    </message>
    <message>
        <source>Centroid from the middle of b</source>
        <translation>形心到 b 中点的距离</translation>
    </message>
    <message>
        <source>Centroid from the middle of h</source>
        <translation>形心到 h 中点的距离</translation>
    </message>
    <message>
        <source>Colour of each plate, in mark order; empty for the view's own</source>
        <translation>各板件的颜色，按编号顺序；空表示用视图自身的颜色</translation>
    </message>
    <message>
        <source>Colours</source>
        <translation>颜色</translation>
    </message>
    <message>
        <source>Constant (d) and transition (b) zones: start and end, mm, slope, the paper's group</source>
        <translation>等截面（d）与过渡（b）区段：起点和终点 mm、坡度、所属组别</translation>
    </message>
    <message>
        <source>Corners of a polygon in turn, as (0, y, z) mm</source>
        <translation>多边形各角点，依次为 (0, y, z) mm</translation>
    </message>
    <message>
        <source>Cut by a plane through the point, instead of the end of the axis</source>
        <translation>用过该点的平面切割，而不在轴线端点处</translation>
    </message>
    <message>
        <source>Cut files</source>
        <translation>切割文件</translation>
    </message>
    <message>
        <source>Delivery piece of each mark</source>
        <translation>各编号所属的运输单元</translation>
    </message>
    <message>
        <source>Delivery pieces: number, start and end, mm, and number of parts</source>
        <translation>运输单元：序号、起点和终点 mm、零件数</translation>
    </message>
    <message>
        <source>Diaphragms</source>
        <translation>隔板</translation>
    </message>
    <message>
        <source>Direction as given, or by rule: low end to high, else along +x</source>
        <translation>方向按给定，或按规则：由低端到高端，否则沿 +x</translation>
    </message>
    <message>
        <source>Direction of the height, for frame fixed</source>
        <translation>高度方向，用于固定标架</translation>
    </message>
    <message>
        <source>Display</source>
        <translation>显示</translation>
    </message>
    <message>
        <source>Distance along the outward normals</source>
        <translation>沿外法线的距离</translation>
    </message>
    <message>
        <source>Distance between the axes</source>
        <translation>两轴线的距离</translation>
    </message>
    <message>
        <source>Distance from the surface, for fit offset</source>
        <translation>到曲面的距离，用于偏移贴合</translation>
    </message>
    <message>
        <source>Drawn by, in the title block</source>
        <translation>标题栏中的制图人</translation>
    </message>
    <message>
        <source>Edges</source>
        <translation>焊缝</translation>
    </message>
    <message>
        <source>Ends</source>
        <translation>端部</translation>
    </message>
    <message>
        <source>Everything the last recompute found, one record (JSON) per line</source>
        <translation>上次重算的全部检查结果，每行一条记录（JSON）</translation>
    </message>
    <message>
        <source>Extra twist: angle in degrees, one per place, smooth between</source>
        <translation>附加扭转：每处的角度（度），其间平滑过渡</translation>
    </message>
    <message>
        <source>Extra twist: places along the axis, ratios up to 1 or mm</source>
        <translation>附加扭转：沿轴线的位置，不大于 1 的比例或 mm</translation>
    </message>
    <message>
        <source>Face</source>
        <translation>面</translation>
    </message>
    <message>
        <source>Face closed last: top slot, top slot 100x24 @ 250, top weld, top weld 10</source>
        <translation>最后封闭的面：top slot、top slot 100x24 @ 250、top weld、top weld 10</translation>
    </message>
    <message>
        <source>Face of the surface, counted from 0 (iso-curve)</source>
        <translation>曲面的面序号，从 0 起（等参线）</translation>
    </message>
    <message>
        <source>Faces divided into as few lanes as the stock of the rule pack allows</source>
        <translation>在规则包库存板材允许下分成尽量少分条的面</translation>
    </message>
    <message>
        <source>Faces each end of the branch lands on</source>
        <translation>支构件各端所落的面</translation>
    </message>
    <message>
        <source>Faces whose joints are solved by the rule pack, instead of their lists</source>
        <translation>拼接缝由规则包求解而不按列表的面</translation>
    </message>
    <message>
        <source>Field gap to the next piece, mm</source>
        <translation>与下一单元的现场间隙，mm</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>贴合</translation>
    </message>
    <message>
        <source>Forming</source>
        <translation>成形</translation>
    </message>
    <message>
        <source>Forming class of each plate: flat, elastic, cold or hot</source>
        <translation>各板件的成形类别：平板、弹性、冷弯或热弯</translation>
    </message>
    <message>
        <source>Frame</source>
        <translation>标架</translation>
    </message>
    <message>
        <source>Frame given: angle in degrees against the minimal frame, one per place</source>
        <translation>给定标架：每处相对最小旋转标架的角度（度）</translation>
    </message>
    <message>
        <source>Frame given: direction of the height, one per place, instead of angles</source>
        <translation>给定标架：每处的高度方向，代替角度</translation>
    </message>
    <message>
        <source>Frame given: places along the axis, ratios up to 1 or mm</source>
        <translation>给定标架：沿轴线的位置，不大于 1 的比例或 mm</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>标架</translation>
    </message>
    <message>
        <source>Free list, a strip per line: face, letter, y1, z1, y2, z2, t, side (left right middle), stop1, stop2</source>
        <translation>自由列表，每行一块板条：面、字母、y1、z1、y2、z2、t、侧（left right middle）、stop1、stop2</translation>
    </message>
    <message>
        <source>From the axis of the member that runs through, along the branch, to the field joint behind a stub</source>
        <translation>由贯通构件轴线沿支构件到牛腿后的现场拼接缝</translation>
    </message>
    <message>
        <source>From the middle of the face towards its second edge, mm</source>
        <translation>由面的中线朝其第二条边，mm</translation>
    </message>
    <message>
        <source>From the site's x axis to the model's, about the vertical</source>
        <translation>绕铅垂线由现场 x 轴转到模型 x 轴</translation>
    </message>
    <message>
        <source>Gap to each wall, mm; of end plates to the outer faces, negative for an overhang</source>
        <translation>到各壁板的间隙，mm；端板为到外表面，负值表示外伸</translation>
    </message>
    <message>
        <source>Green length at its end, mm</source>
        <translation>终端余量，mm</translation>
    </message>
    <message>
        <source>Green length at its start, mm</source>
        <translation>始端余量，mm</translation>
    </message>
    <message>
        <source>Half angle (cone)</source>
        <translation>半锥角（圆锥）</translation>
    </message>
    <message>
        <source>Half the height of the down face's edges about the plane, largest of all pieces, mm</source>
        <translation>朝下面各边相对该平面的高差之半，取各单元最大值，mm</translation>
    </message>
    <message>
        <source>Half-axis along x (ellipsoid)</source>
        <translation>沿 x 的半轴（椭球）</translation>
    </message>
    <message>
        <source>Half-axis along y (ellipsoid)</source>
        <translation>沿 y 的半轴（椭球）</translation>
    </message>
    <message>
        <source>Half-axis along z (ellipsoid)</source>
        <translation>沿 z 的半轴（椭球）</translation>
    </message>
    <message>
        <source>Height h over the outer faces</source>
        <translation>外表面之间的高度 h</translation>
    </message>
    <message>
        <source>Height of the end</source>
        <translation>终端标高</translation>
    </message>
    <message>
        <source>Height of the lowest pin above the pins' base</source>
        <translation>最低销高出销底座的高度</translation>
    </message>
    <message>
        <source>Height of the lowest seat above the floor</source>
        <translation>最低支座高出地面的高度</translation>
    </message>
    <message>
        <source>Height of the ribbon; 0 for one that suits</source>
        <translation>标架带的高度；0 为自动</translation>
    </message>
    <message>
        <source>Height of the start</source>
        <translation>始端标高</translation>
    </message>
    <message>
        <source>How much larger than the section templates are cut, all round</source>
        <translation>样板四周比截面放大的量</translation>
    </message>
    <message>
        <source>ISO: first angle, weld symbols of ISO 2553; AWS: third angle, of AWS A2.4</source>
        <translation>ISO：第一角投影，ISO 2553 焊缝符号；AWS：第三角投影，AWS A2.4 焊缝符号</translation>
    </message>
    <message>
        <source>Joints of the face: cumulative ratios (up to 1) or mm from the start</source>
        <translation>该面的拼接缝：累计比例（不大于 1）或距始端 mm</translation>
    </message>
    <message>
        <source>Joints welded flat, before forming: allowance at the ends; after forming, in the box: spread over the plate</source>
        <translation>拼接缝在成形前平焊：加量放在端部；成形后在箱体中焊：加量分布于全板</translation>
    </message>
    <message>
        <source>Kind of surface</source>
        <translation>曲面种类</translation>
    </message>
    <message>
        <source>Labels</source>
        <translation>标注</translation>
    </message>
    <message>
        <source>Language of the labels</source>
        <translation>标注语言</translation>
    </message>
    <message>
        <source>Largest distance of control points; 0: no limit</source>
        <translation>控制点最大间距；0：不限</translation>
    </message>
    <message>
        <source>Largest distance of measuring lines along any corner line</source>
        <translation>测量线沿任一棱线的最大间距</translation>
    </message>
    <message>
        <source>Largest distance of saddles; they stand at diaphragms besides</source>
        <translation>托架最大间距；隔板处另设托架</translation>
    </message>
    <message>
        <source>Largest distance of templates, as far as there are stations</source>
        <translation>样板最大间距，以有测站为限</translation>
    </message>
    <message>
        <source>Largest distance of the axis to its surface</source>
        <translation>轴线到其曲面的最大距离</translation>
    </message>
    <message>
        <source>Largest distance of the curve from the chord of control points; 0: no limit</source>
        <translation>曲线到控制点弦线的最大距离；0：不限</translation>
    </message>
    <message>
        <source>Largest flat minus true area of a plate, mm2</source>
        <translation>板件展开面积减真实面积的最大值，mm2</translation>
    </message>
    <message>
        <source>Largest flat minus true length of the centre lines, mm</source>
        <translation>中心线展开长减真实长的最大值，mm</translation>
    </message>
    <message>
        <source>Largest flat minus true length of the lines, mm</source>
        <translation>各线展开长减真实长的最大值，mm</translation>
    </message>
    <message>
        <source>Largest flat minus true length of the long edges, mm</source>
        <translation>长边展开长减真实长的最大值，mm</translation>
    </message>
    <message>
        <source>Largest flat minus true length of the panel diagonals, mm</source>
        <translation>格板对角线展开长减真实长的最大值，mm</translation>
    </message>
    <message>
        <source>Largest flat minus true length over edges, lines and diagonals, mm</source>
        <translation>各边、线、对角线展开长减真实长的最大值，mm</translation>
    </message>
    <message>
        <source>Largest miss of the stations of two plates along their seam, mm</source>
        <translation>相邻两板沿棱缝测站的最大错位，mm</translation>
    </message>
    <message>
        <source>Largest strain of laying a plate flat</source>
        <translation>板件展平的最大应变</translation>
    </message>
    <message>
        <source>Largest turn of the normal about the axis between control points; 0: no limit</source>
        <translation>控制点之间法线绕轴线的最大转角；0：不限</translation>
    </message>
    <message>
        <source>Largest turn of the tangent between control points; 0: no limit</source>
        <translation>控制点之间切线的最大转角；0：不限</translation>
    </message>
    <message>
        <source>Largest twist of the frame, degrees per metre</source>
        <translation>标架的最大扭率，度每米</translation>
    </message>
    <message>
        <source>Layers of the DXF files by other names: CUT_OUTER=10, MARK_LINE=20, …</source>
        <translation>DXF 文件图层的其他名称：CUT_OUTER=10, MARK_LINE=20, …</translation>
    </message>
    <message>
        <source>Least and largest value of the colours, to compare members; empty: those of its own</source>
        <translation>颜色对应的最小值和最大值，用于比较构件；空：用自身的</translation>
    </message>
    <message>
        <source>Least distance between the thickness joints of adjacent faces</source>
        <translation>相邻面变厚拼接缝之间的最小距离</translation>
    </message>
    <message>
        <source>Least distance of a staggered thickness joint from a fold</source>
        <translation>错开的变厚拼接缝到折线的最小距离</translation>
    </message>
    <message>
        <source>Left beyond the end lines at the end of the member, mm</source>
        <translation>构件终端端线外的余量，mm</translation>
    </message>
    <message>
        <source>Left beyond the end lines at the start of the member, mm</source>
        <translation>构件始端端线外的余量，mm</translation>
    </message>
    <message>
        <source>Legs of the corners cut off, mm</source>
        <translation>切角的边长，mm</translation>
    </message>
    <message>
        <source>Length of the axis</source>
        <translation>轴线长度</translation>
    </message>
    <message>
        <source>Length of the chamfer of the thicker plate over its depth; 0 for none</source>
        <translation>较厚板削斜的长度与深度之比；0 表示不削斜</translation>
    </message>
    <message>
        <source>Length of the transition per millimetre of step; 0 for a step</source>
        <translation>每毫米高差的过渡长度；0 表示突变</translation>
    </message>
    <message>
        <source>Linear, with a fold at each end, or smooth over the same length</source>
        <translation>直线过渡、两端有折线，或在同样长度内平滑过渡</translation>
    </message>
    <message>
        <source>Make the branch flush with the member that runs through</source>
        <translation>使支构件与贯通构件齐平</translation>
    </message>
    <message>
        <source>Manhole: d=400, 400x600, 400x600 r=100; at 50 -100 moves it along breadth and height</source>
        <translation>人孔：d=400、400x600、400x600 r=100；at 50 -100 沿宽度和高度移动</translation>
    </message>
    <message>
        <source>Marks</source>
        <translation>面上标记</translation>
    </message>
    <message>
        <source>Mass of all plates, kg</source>
        <translation>全部板件的质量，kg</translation>
    </message>
    <message>
        <source>Mass of each piece, kg</source>
        <translation>各单元的质量，kg</translation>
    </message>
    <message>
        <source>Material</source>
        <translation>材料</translation>
    </message>
    <message>
        <source>Member</source>
        <translation>构件</translation>
    </message>
    <message>
        <source>Members that end at this node as well, which Other ends on where they overlap, whatever the ranks</source>
        <translation>同样止于本节点的构件；重叠处 Other 止于其上，不论等级</translation>
    </message>
    <message>
        <source>Members that end at this node as well: of two that overlap, the one of lower Rank is ended on by the other</source>
        <translation>同样止于本节点的构件：两者重叠时，另一根止于 Rank 较小的一根</translation>
    </message>
    <message>
        <source>Middle of the outer face of each mark</source>
        <translation>各编号外表面的中点</translation>
    </message>
    <message>
        <source>Model to bed frame of each piece: the sixteen numbers of its matrix, row by row</source>
        <translation>各单元由模型到胎架坐标系的矩阵：逐行十六个数</translation>
    </message>
    <message>
        <source>Moves the cut along the axis</source>
        <translation>沿轴线移动分段点</translation>
    </message>
    <message>
        <source>Moves the cut outwards, along the axis or off the face</source>
        <translation>将切割面外移，沿轴线或离开该面</translation>
    </message>
    <message>
        <source>Name of the node; branches of one node share it</source>
        <translation>节点名称；同一节点的各支构件共用</translation>
    </message>
    <message>
        <source>Name, density kg/m3, E MPa, fy MPa; empty: that of the walls</source>
        <translation>名称、密度 kg/m3、E MPa、fy MPa；空：同壁板</translation>
    </message>
    <message>
        <source>Near the end (plane section, geodesic), mm</source>
        <translation>终点附近（平面截交、测地线），mm</translation>
    </message>
    <message>
        <source>Near the start (plane section, geodesic), mm</source>
        <translation>起点附近（平面截交、测地线），mm</translation>
    </message>
    <message>
        <source>Net area of each pattern, mm2</source>
        <translation>各展开图的净面积，mm2</translation>
    </message>
    <message>
        <source>Node</source>
        <translation>节点</translation>
    </message>
    <message>
        <source>Non-destructive test; empty: the rule pack's</source>
        <translation>无损检测；空：按规则包</translation>
    </message>
    <message>
        <source>Normal of a cut by plane</source>
        <translation>按平面切割时的法线</translation>
    </message>
    <message>
        <source>Number of each delivery piece, along +s</source>
        <translation>各运输单元的序号，沿 +s</translation>
    </message>
    <message>
        <source>Number of pages</source>
        <translation>页数</translation>
    </message>
    <message>
        <source>Number of plates</source>
        <translation>板件数</translation>
    </message>
    <message>
        <source>Number of segments</source>
        <translation>段数</translation>
    </message>
    <message>
        <source>Number of the page, from 0</source>
        <translation>页序号，从 0 起</translation>
    </message>
    <message>
        <source>Of points: pull brings the axis onto the surface, keep leaves it on them, offset holds it at a distance; an axis from a curve keeps to the curve</source>
        <translation>对点而言：pull 把轴线拉到曲面上，keep 使轴线留在各点上，offset 与曲面保持距离；由曲线得到的轴线保持在曲线上</translation>
    </message>
    <message>
        <source>Offset along the breadth</source>
        <translation>沿宽度方向的偏移</translation>
    </message>
    <message>
        <source>Offset along the height</source>
        <translation>沿高度方向的偏移</translation>
    </message>
    <message>
        <source>Offset of the whole member along its breadth</source>
        <translation>整根构件沿宽度的偏移</translation>
    </message>
    <message>
        <source>Offset of the whole member along its height</source>
        <translation>整根构件沿高度的偏移</translation>
    </message>
    <message>
        <source>Offsets of the faces' thickness joints: auto, none, or mm such as top=0 left=200</source>
        <translation>各面变厚拼接缝的错开：auto、none，或 mm，如 top=0 left=200</translation>
    </message>
    <message>
        <source>Openings</source>
        <translation>开孔</translation>
    </message>
    <message>
        <source>Origin</source>
        <translation>原点</translation>
    </message>
    <message>
        <source>Outward direction there, as long as the plate is wide</source>
        <translation>该处的外向方向，长度等于板宽</translation>
    </message>
    <message>
        <source>Pages for the plates, too, about 0.1 s for each. The PDF has them always</source>
        <translation>板件也各设一页，每页约 0.1 s。PDF 中始终有</translation>
    </message>
    <message>
        <source>Per plate: bending moment that pulls it into shape, kNm</source>
        <translation>每块板：将其拉到位的弯矩，kNm</translation>
    </message>
    <message>
        <source>Per plate: clamping force at each corner beside its own weight, kN</source>
        <translation>每块板：自重之外各角的夹紧力，kN</translation>
    </message>
    <message>
        <source>Per plate: clamping force at mid-length beside its own weight, kN</source>
        <translation>每块板：自重之外中部的夹紧力，kN</translation>
    </message>
    <message>
        <source>Per plate: class, the rule that decided, and how it is brought into shape</source>
        <translation>每块板：类别、所依据的规则、成形方法</translation>
    </message>
    <message>
        <source>Per plate: half its height about the best plane, mm</source>
        <translation>每块板：相对最佳平面高差之半，mm</translation>
    </message>
    <message>
        <source>Per plate: largest flat minus true length over edges, lines and diagonals, mm</source>
        <translation>每块板：各边、线、对角线展开长减真实长的最大值，mm</translation>
    </message>
    <message>
        <source>Per plate: largest strain of laying it flat</source>
        <translation>每块板：展平的最大应变</translation>
    </message>
    <message>
        <source>Per plate: largest stress of forcing it elastically into shape, MPa</source>
        <translation>每块板：弹性强制成形的最大应力，MPa</translation>
    </message>
    <message>
        <source>Per plate: largest twist, degrees per metre</source>
        <translation>每块板：最大扭率，度每米</translation>
    </message>
    <message>
        <source>Per plate: length as cut, mm</source>
        <translation>每块板：下料长度，mm</translation>
    </message>
    <message>
        <source>Per plate: membrane stress of that, MPa</source>
        <translation>每块板：其薄膜应力，MPa</translation>
    </message>
    <message>
        <source>Per plate: net length of its pattern, mm</source>
        <translation>每块板：展开图净长，mm</translation>
    </message>
    <message>
        <source>Per plate: net width of its pattern, mm</source>
        <translation>每块板：展开图净宽，mm</translation>
    </message>
    <message>
        <source>Per plate: smallest bending radius, mm; infinite for a flat one</source>
        <translation>每块板：最小弯曲半径，mm；平板为无穷大</translation>
    </message>
    <message>
        <source>Per plate: what no flat pattern can be below in that, mm</source>
        <translation>每块板：任何展开图在此项上的下限，mm</translation>
    </message>
    <message>
        <source>Per plate: width as cut, mm</source>
        <translation>每块板：下料宽度，mm</translation>
    </message>
    <message>
        <source>Per saddle: piece, label, s, heights of the left and the right seat in mm</source>
        <translation>每个托架：单元、编号、s、左右支座高度 mm</translation>
    </message>
    <message>
        <source>Pieces</source>
        <translation>运输单元</translation>
    </message>
    <message>
        <source>Pins</source>
        <translation>销</translation>
    </message>
    <message>
        <source>Pitch of the pin grid; 0 for none</source>
        <translation>销阵间距；0 表示无</translation>
    </message>
    <message>
        <source>Place on the branch</source>
        <translation>在支构件上的位置</translation>
    </message>
    <message>
        <source>Place on the member that runs through</source>
        <translation>在贯通构件上的位置</translation>
    </message>
    <message>
        <source>Places of nodes along the axis, which joints keep clear of, mm</source>
        <translation>沿轴线的节点位置，拼接缝须避开，mm</translation>
    </message>
    <message>
        <source>Plate thickness where no other is given</source>
        <translation>未另给厚度处的板厚</translation>
    </message>
    <message>
        <source>Plates</source>
        <translation>板件</translation>
    </message>
    <message>
        <source>Points form a ring</source>
        <translation>各点构成闭合环</translation>
    </message>
    <message>
        <source>Points in the order given, or chained from neighbour to neighbour</source>
        <translation>各点按给定顺序，或按相邻关系串接</translation>
    </message>
    <message>
        <source>Points the axis runs through</source>
        <translation>轴线通过的点</translation>
    </message>
    <message>
        <source>Points, mm; used when nothing is picked and no rule is set</source>
        <translation>各点，mm；未选取且未设规则时使用</translation>
    </message>
    <message>
        <source>Position marks, as the faces</source>
        <translation>位置编号，与面同序</translation>
    </message>
    <message>
        <source>Position marks, as the solids</source>
        <translation>位置编号，与实体同序</translation>
    </message>
    <message>
        <source>Preset</source>
        <translation>预拱</translation>
    </message>
    <message>
        <source>Product moment, mm4</source>
        <translation>惯性积，mm4</translation>
    </message>
    <message>
        <source>Project name in the title block</source>
        <translation>标题栏中的项目名称</translation>
    </message>
    <message>
        <source>Radius (sphere, cylinder, cone at z = 0, torus tube)</source>
        <translation>半径（球、圆柱、z = 0 处的圆锥、圆环管）</translation>
    </message>
    <message>
        <source>Radius of the circle the tube follows (torus)</source>
        <translation>圆管中心圆的半径（圆环）</translation>
    </message>
    <message>
        <source>Raise the end by this, along the axis</source>
        <translation>终端抬高此值，沿轴线渐变</translation>
    </message>
    <message>
        <source>Raise the start by this, along the axis</source>
        <translation>始端抬高此值，沿轴线渐变</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>结果</translation>
    </message>
    <message>
        <source>Reverse the outward side</source>
        <translation>反转外侧</translation>
    </message>
    <message>
        <source>Root gap on the left (box1, webs run through) or at the top of the webs; of all corners of a polygon</source>
        <translation>左侧（box1，腹板贯通）或腹板顶部的根部间隙；多边形为所有角</translation>
    </message>
    <message>
        <source>Root gap on the right (box1, webs run through) or at the bottom of the webs</source>
        <translation>右侧（box1，腹板贯通）或腹板底部的根部间隙</translation>
    </message>
    <message>
        <source>Root gap to the outer faces</source>
        <translation>到外表面的根部间隙</translation>
    </message>
    <message>
        <source>Root mean square distance of the axis to its surface</source>
        <translation>轴线到其曲面距离的均方根</translation>
    </message>
    <message>
        <source>Rule</source>
        <translation>规则曲线</translation>
    </message>
    <message>
        <source>Run the end on along the axis; negative trims it</source>
        <translation>终端沿轴线延长；负值为截短</translation>
    </message>
    <message>
        <source>Run the start on along the axis; negative trims it</source>
        <translation>始端沿轴线延长；负值为截短</translation>
    </message>
    <message>
        <source>Scale of the comb (mm2) or height of the ribbon (mm); 0: to suit</source>
        <translation>曲率梳比例（mm2）或标架带高度（mm）；0：自动</translation>
    </message>
    <message>
        <source>Seams that divide the face along: cumulative ratios (up to 1) or mm of its width</source>
        <translation>将该面纵向分条的缝：其宽度的累计比例（不大于 1）或 mm</translation>
    </message>
    <message>
        <source>Second moment about the y axis through the centroid, mm4</source>
        <translation>绕过形心 y 轴的惯性矩，mm4</translation>
    </message>
    <message>
        <source>Second moment about the z axis through the centroid, mm4</source>
        <translation>绕过形心 z 轴的惯性矩，mm4</translation>
    </message>
    <message>
        <source>Section</source>
        <translation>截面</translation>
    </message>
    <message>
        <source>Segment 1</source>
        <translation>第 1 段</translation>
    </message>
    <message>
        <source>Segment 10</source>
        <translation>第 10 段</translation>
    </message>
    <message>
        <source>Segment 11</source>
        <translation>第 11 段</translation>
    </message>
    <message>
        <source>Segment 12</source>
        <translation>第 12 段</translation>
    </message>
    <message>
        <source>Segment 2</source>
        <translation>第 2 段</translation>
    </message>
    <message>
        <source>Segment 3</source>
        <translation>第 3 段</translation>
    </message>
    <message>
        <source>Segment 4</source>
        <translation>第 4 段</translation>
    </message>
    <message>
        <source>Segment 5</source>
        <translation>第 5 段</translation>
    </message>
    <message>
        <source>Segment 6</source>
        <translation>第 6 段</translation>
    </message>
    <message>
        <source>Segment 7</source>
        <translation>第 7 段</translation>
    </message>
    <message>
        <source>Segment 8</source>
        <translation>第 8 段</translation>
    </message>
    <message>
        <source>Segment 9</source>
        <translation>第 9 段</translation>
    </message>
    <message>
        <source>Several picked edges, wires, sketches or points, in any order</source>
        <translation>所选的多条边、线框、草图或点，顺序任意</translation>
    </message>
    <message>
        <source>Sheets</source>
        <translation>图纸</translation>
    </message>
    <message>
        <source>Sheets there are, such as 12000x2500; 16 10000x2000; 30 S460 8000x2200 (thickness and grade where it is theirs alone); empty: the rule pack's</source>
        <translation>现有板材，如 12000x2500; 16 10000x2000; 30 S460 8000x2200（仅适用于某厚度和牌号时写出）；空：按规则包</translation>
    </message>
    <message>
        <source>Show station lines and the labels of L and P</source>
        <translation>显示测量线及 L、P 编号</translation>
    </message>
    <message>
        <source>Show the mark of each plate</source>
        <translation>显示每块板的编号</translation>
    </message>
    <message>
        <source>Show where the height of sections points</source>
        <translation>显示截面高度所指的方向</translation>
    </message>
    <message>
        <source>Shrinkage across the member, added to the patterns, mm per m</source>
        <translation>横向收缩，加到展开图上，mm 每 m</translation>
    </message>
    <message>
        <source>Shrinkage along the member, added to the patterns, mm per m</source>
        <translation>纵向收缩，加到展开图上，mm 每 m</translation>
    </message>
    <message>
        <source>Site</source>
        <translation>现场</translation>
    </message>
    <message>
        <source>Size of the pages</source>
        <translation>图纸幅面</translation>
    </message>
    <message>
        <source>Smallest radius of curvature; 0 for a straight axis</source>
        <translation>最小曲率半径；直线轴线为 0</translation>
    </message>
    <message>
        <source>Station lines that have a template besides: L-3, …</source>
        <translation>另设样板的测量线：L-3, …</translation>
    </message>
    <message>
        <source>Steel grade</source>
        <translation>钢材牌号</translation>
    </message>
    <message>
        <source>Steepest slope from seat to seat, degrees</source>
        <translation>支座之间的最大坡度，度</translation>
    </message>
    <message>
        <source>Steps of the top, bottom, left and right face at each cut, mm</source>
        <translation>各分段点处顶、底、左、右面的错台，mm</translation>
    </message>
    <message>
        <source>Surface</source>
        <translation>曲面</translation>
    </message>
    <message>
        <source>Take the distance as the points' mean distance, for fit offset</source>
        <translation>以各点的平均距离为距离，用于偏移贴合</translation>
    </message>
    <message>
        <source>Templates</source>
        <translation>样板</translation>
    </message>
    <message>
        <source>The assembly bed shown, if any</source>
        <translation>图中所示的拼装胎架（如有）</translation>
    </message>
    <message>
        <source>The axis the member follows</source>
        <translation>构件所沿的轴线</translation>
    </message>
    <message>
        <source>The crossing axis</source>
        <translation>相交的轴线</translation>
    </message>
    <message>
        <source>The face of each piece that lies down</source>
        <translation>各单元朝下的面</translation>
    </message>
    <message>
        <source>The face patterns are seen from and marked on</source>
        <translation>展开图的视图面和划线面</translation>
    </message>
    <message>
        <source>The face that lies down: bottom, top, left, right, …, or auto, the flattest</source>
        <translation>朝下的面：bottom、top、left、right、…，或 auto（最平的面）</translation>
    </message>
    <message>
        <source>The face, or a whole shape of faces, for kind `face`</source>
        <translation>种类为 `face` 时：一个面，或由面组成的整个形体</translation>
    </message>
    <message>
        <source>The flat patterns these sheets show</source>
        <translation>图纸所示的展开图</translation>
    </message>
    <message>
        <source>The member cut into plates</source>
        <translation>被分成板件的构件</translation>
    </message>
    <message>
        <source>The member that ends on it</source>
        <translation>止于其上的构件</translation>
    </message>
    <message>
        <source>The member that runs through</source>
        <translation>贯通构件</translation>
    </message>
    <message>
        <source>The model's origin on the site</source>
        <translation>模型原点在现场的位置</translation>
    </message>
    <message>
        <source>The nodes the member takes part in</source>
        <translation>构件所在的节点</translation>
    </message>
    <message>
        <source>The parameter held (iso-curve)</source>
        <translation>保持不变的参数（等参线）</translation>
    </message>
    <message>
        <source>The plane's normal (plane section)</source>
        <translation>平面的法线（平面截交）</translation>
    </message>
    <message>
        <source>The plates laid flat</source>
        <translation>被展平的板件</translation>
    </message>
    <message>
        <source>The plates to be put together</source>
        <translation>要拼装的板件</translation>
    </message>
    <message>
        <source>The points of this axis at CrossingPlaces</source>
        <translation>本轴线在 CrossingPlaces 处的点</translation>
    </message>
    <message>
        <source>The rules joints are checked by and solved for, and plates formed by</source>
        <translation>拼接缝校核与求解以及板件成形所依据的规则</translation>
    </message>
    <message>
        <source>The rules the node is checked by</source>
        <translation>节点校核所依据的规则</translation>
    </message>
    <message>
        <source>The same points before the preset</source>
        <translation>预拱前的同一批点</translation>
    </message>
    <message>
        <source>The section</source>
        <translation>截面</translation>
    </message>
    <message>
        <source>The sheet set this page belongs to</source>
        <translation>本页所属的图纸集</translation>
    </message>
    <message>
        <source>The sheet sets of the members shown; drawn in the style of the first</source>
        <translation>所示构件的图纸集；按第一份的样式绘制</translation>
    </message>
    <message>
        <source>The surface of the plates that is laid flat and measured</source>
        <translation>板件中被展平和量测的面</translation>
    </message>
    <message>
        <source>The surface that turns the sections</source>
        <translation>决定截面朝向的曲面</translation>
    </message>
    <message>
        <source>Thickness changes</source>
        <translation>变厚</translation>
    </message>
    <message>
        <source>Thickness of each side of a polygon, mm; empty for Thickness</source>
        <translation>多边形各边的厚度，mm；空表示同 Thickness</translation>
    </message>
    <message>
        <source>Thickness of the bottom plate; 0 for Thickness</source>
        <translation>底板厚度；0 表示同 Thickness</translation>
    </message>
    <message>
        <source>Thickness of the top plate; 0 for Thickness</source>
        <translation>顶板厚度；0 表示同 Thickness</translation>
    </message>
    <message>
        <source>Thickness of the webs; 0 for Thickness</source>
        <translation>腹板厚度；0 表示同 Thickness</translation>
    </message>
    <message>
        <source>Thickness, mm</source>
        <translation>厚度，mm</translation>
    </message>
    <message>
        <source>Torsion angle from start to end</source>
        <translation>由始端到终端的扭转角</translation>
    </message>
    <message>
        <source>Torsion constant, mm4: Bredt when closed, sum of bt³/3 when open</source>
        <translation>扭转常数，mm4：闭口按 Bredt 公式，开口为 bt³/3 之和</translation>
    </message>
    <message>
        <source>Transition length from the largest step of a face, or from the total change</source>
        <translation>过渡长度按某一面的最大高差，或按总变化量</translation>
    </message>
    <message>
        <source>Turn about the axis</source>
        <translation>绕轴线的转角</translation>
    </message>
    <message>
        <source>Turn of the frame about the axis</source>
        <translation>标架绕轴线的转角</translation>
    </message>
    <message>
        <source>Turn the direction; points keep their numbers</source>
        <translation>反转方向；各点编号不变</translation>
    </message>
    <message>
        <source>Turns the shape from the member's direction towards the second edge, degrees</source>
        <translation>将形状由构件方向转向第二条边，度</translation>
    </message>
    <message>
        <source>Unfold</source>
        <translation>展开</translation>
    </message>
    <message>
        <source>Unit of dimensions and sizes</source>
        <translation>尺寸的单位</translation>
    </message>
    <message>
        <source>Unit of site values on the sheets</source>
        <translation>图纸上现场坐标的单位</translation>
    </message>
    <message>
        <source>Upward direction of a bed by normal, in the model</source>
        <translation>按法线的胎架在模型中的向上方向</translation>
    </message>
    <message>
        <source>Volume of all plates</source>
        <translation>全部板件的体积</translation>
    </message>
    <message>
        <source>Weld: a seam such as TL, a joint such as T1/T2, a node, a diaphragm such as D1; or joints, nodes, diaphragms, end plates for all of them</source>
        <translation>焊缝：棱缝如 TL、拼接缝如 T1/T2、节点、隔板如 D1；或 joints、nodes、diaphragms、end plates 表示全部</translation>
    </message>
    <message>
        <source>What cut files draw of bevelled edges: the edge of the surface laid flat; of the marking face (top); the line where groove and land meet; the outermost line</source>
        <translation>切割文件中坡口边所画的线：展平面的边；划线面（top）的边；坡口与钝边的交线；最外的线</translation>
    </message>
    <message>
        <source>What is picked is an exact curve, which the axis keeps to, or points to fit through; automatic: polylines are points</source>
        <translation>所选为精确曲线（轴线保持在其上），或供拟合的点；automatic：折线视为点</translation>
    </message>
    <message>
        <source>What lies on the axis, or is flush with the segment before</source>
        <translation>位于轴线上，或与前一段齐平的部位</translation>
    </message>
    <message>
        <source>What of the branch goes on inside the member that runs through</source>
        <translation>支构件在贯通构件内部延续的部分</translation>
    </message>
    <message>
        <source>What the axis shows beside its line</source>
        <translation>轴线除线以外所显示的内容</translation>
    </message>
    <message>
        <source>What the colours mean: colour and value</source>
        <translation>颜色的含义：颜色和数值</translation>
    </message>
    <message>
        <source>What the plates are coloured by in the window</source>
        <translation>窗口中板件的着色依据</translation>
    </message>
    <message>
        <source>What the points leave open: largest distance of a point from the axis without it</source>
        <translation>各点未定的程度：去掉某点后轴线到该点的最大距离</translation>
    </message>
    <message>
        <source>Where CrossingAxes cross, in their order: mm from the start</source>
        <translation>CrossingAxes 的相交位置，按其顺序：距始端 mm</translation>
    </message>
    <message>
        <source>Where it ends; empty: at the end of the member</source>
        <translation>终点；空：在构件终端</translation>
    </message>
    <message>
        <source>Where it ends; empty: where the next starts, or the member ends</source>
        <translation>终点；空：下一单元起点或构件终端</translation>
    </message>
    <message>
        <source>Where it is held, as a part of its range (iso-curve)</source>
        <translation>保持的位置，以其范围的比例表示（等参线）</translation>
    </message>
    <message>
        <source>Where it starts as a part of the length; 0 to use the distance</source>
        <translation>起点占长度的比例；0 表示用距离</translation>
    </message>
    <message>
        <source>Where it starts: mm or a ratio such as 35%; empty: at the start of the member</source>
        <translation>起点：mm 或比例如 35%；空：在构件始端</translation>
    </message>
    <message>
        <source>Where it starts: mm or a ratio such as 35%; empty: where the one before ends</source>
        <translation>起点：mm 或比例如 35%；空：前一单元终点</translation>
    </message>
    <message>
        <source>Where members meet the lower rank runs through</source>
        <translation>构件相交处等级小者贯通</translation>
    </message>
    <message>
        <source>Where the containers stood at the last recompute that it and what it uses are in</source>
        <translation>上次重算时，该对象及其所用对象所在容器的位置</translation>
    </message>
    <message>
        <source>Where the curve ends, as a part of the other range (iso-curve)</source>
        <translation>曲线终点，以另一参数范围的比例表示（等参线）</translation>
    </message>
    <message>
        <source>Where the curve starts, as a part of the other range (iso-curve)</source>
        <translation>曲线起点，以另一参数范围的比例表示（等参线）</translation>
    </message>
    <message>
        <source>Where the section's height points: surface, its normal; minimal, never turning about the axis; fixed, one direction; given, by the table</source>
        <translation>截面高度的指向：surface，曲面法线；minimal，不绕轴线转动；fixed，固定方向；given，按表</translation>
    </message>
    <message>
        <source>Where the transition to the segment starts, from the start of the axis; of segment 1 on closed axes only</source>
        <translation>到本段的过渡的起点，由轴线始端量起；第 1 段仅用于闭合轴线</translation>
    </message>
    <message>
        <source>Where: mm from the start, a ratio such as 35%, or start and end for end plates</source>
        <translation>位置：距始端 mm、比例如 35%，端板用 start 和 end</translation>
    </message>
    <message>
        <source>Where: mm from the start, or a ratio like 35%</source>
        <translation>位置：距始端 mm，或比例如 35%</translation>
    </message>
    <message>
        <source>Where: mm from the start, or a ratio such as 35%</source>
        <translation>位置：距始端 mm，或如 35% 的比例</translation>
    </message>
    <message>
        <source>Which plates run to the corner (trapezoid, polygon): flanges, webs, each over the next (ring), or mitred</source>
        <translation>通到角部的板（梯形、多边形）：翼缘、腹板、依次搭接（环），或斜接</translation>
    </message>
    <message>
        <source>Whole turns of the frame once round a closed axis</source>
        <translation>标架绕闭合轴线一周的整转数</translation>
    </message>
    <message>
        <source>Width over thickness of each flat part, and its class in compression by each rule pack</source>
        <translation>各平板的宽厚比，及其按各规则包的受压类别</translation>
    </message>
    <message>
        <source>Yield strength</source>
        <translation>屈服强度</translation>
    </message>
    <message>
        <source>Young's modulus</source>
        <translation>弹性模量</translation>
    </message>
    <message>
        <source>bevel angle=40 land=6 gap=2 inner backing=30x6; types square, bevel, v, double-bevel, double-v, fillet; empty: that of the rule pack</source>
        <translation>如 bevel angle=40 land=6 gap=2 inner backing=30x6；类型 square、bevel、v、double-bevel、double-v、fillet；空：按规则包</translation>
    </message>
    <message>
        <source>box1: webs full height, flanges between them; box2: flanges full breadth; i: I or H; tee; channel; trapezoid: box with sloping webs; polygon: ring of plates; strips: free list</source>
        <translation>box1：腹板通高，翼缘在其间；box2：翼缘通宽；i：工字形或 H 形；tee：T 形；channel：槽形；trapezoid：斜腹板箱形；polygon：板件围成的环；strips：自由列表</translation>
    </message>
    <message>
        <source>crossing, T, Y, K or corner</source>
        <translation>交叉、T、Y、K 或角部</translation>
    </message>
    <message>
        <source>d=120, 200x100, 200x100 r=20 or slot 120x40; the first size along the member</source>
        <translation>d=120、200x100、200x100 r=20 或 slot 120x40；第一个尺寸沿构件方向</translation>
    </message>
    <message>
        <source>direct: the branch is welded to the outer faces; stub: a stub of it, with a field joint at StubLength</source>
        <translation>direct：支构件焊到外表面；stub：留一段牛腿，在 StubLength 处设现场拼接缝</translation>
    </message>
    <message>
        <source>edges: both long edges keep their length; energy: least strain with straight lines; elastic: least strain</source>
        <translation>edges：两条长边保持长度；energy：直母线下应变最小；elastic：应变最小</translation>
    </message>
    <message>
        <source>fit: the best plane of the face's edges; middle: the face's plane at mid-length; normal: square to Normal</source>
        <translation>fit：面各边的最佳平面；middle：面在中部的平面；normal：垂直于 Normal</translation>
    </message>
    <message>
        <source>kg/m</source>
        <translation>kg/m（每米质量）</translation>
    </message>
    <message>
        <source>kg/m3</source>
        <translation>kg/m3（密度）</translation>
    </message>
    <message>
        <source>link: Through runs through; rank: of the two members the one of lower Rank does</source>
        <translation>link：Through 贯通；rank：两构件中 Rank 较小者贯通</translation>
    </message>
    <message>
        <source>m2/m; of a closed section its outside</source>
        <translation>m2/m；闭口截面为其外侧</translation>
    </message>
    <message>
        <source>ok while there is no error, else the first; Findings have warnings, too</source>
        <translation>没有错误时为 ok，否则为第一个错误；警告也在 Findings 中</translation>
    </message>
    <message>
        <source>place: by Cut or CutRatio; crossing: where CutAxis crosses; point: nearest to CutPoint</source>
        <translation>place：按 Cut 或 CutRatio；crossing：与 CutAxis 相交处；point：距 CutPoint 最近处</translation>
    </message>
    <message>
        <source>punch, line 200, line 200 90deg, or a text</source>
        <translation>punch、line 200、line 200 90deg，或一段文字</translation>
    </message>
    <message>
        <source>shop or field; empty: field where pieces meet</source>
        <translation>shop（工厂）或 field（现场）；空：单元相接处为现场</translation>
    </message>
    <message>
        <source>square to the axis; plumb, upright across it; level; plane, by its normal; surface, at a face</source>
        <translation>square：垂直于轴线；plumb：铅垂横切；level：水平；plane：按法线；surface：沿某个面</translation>
    </message>
    <message>
        <source>square, or stepped top=80 bottom=-80; empty: as the next starts</source>
        <translation>square，或 stepped top=80 bottom=-80；空：同下一单元的始端</translation>
    </message>
    <message>
        <source>square, or stepped top=80 bottom=-80; empty: as the one before ends</source>
        <translation>square，或 stepped top=80 bottom=-80；空：同前一单元的终端</translation>
    </message>
</context>
<context>
    <name>BendTorsion</name>
    <message>
        <source>A page for each plate</source>
        <translation>每块板一页</translation>
    </message>
    <message>
        <source>AWS</source>
        <translation>AWS</translation>
    </message>
    <message>
        <source>About where, if they meet twice</source>
        <translation>大致位置（相交两次时）</translation>
    </message>
    <message>
        <source>Add cut</source>
        <translation>添加分段点</translation>
    </message>
    <message>
        <source>Align to</source>
        <translation>对齐基准</translation>
    </message>
    <message>
        <source>Alignment</source>
        <translation>对齐方式</translation>
    </message>
    <message>
        <source>Assembly bed</source>
        <translation>拼装胎架</translation>
    </message>
    <message>
        <source>Axis</source>
        <translation>轴线</translation>
    </message>
    <message>
        <source>Axis within, of its surface</source>
        <translation>轴线距曲面不超过</translation>
    </message>
    <message>
        <source>Box of many walls</source>
        <translation>多边形箱形</translation>
    </message>
    <message>
        <source>Box with inclined webs</source>
        <translation>斜腹板箱形</translation>
    </message>
    <message>
        <source>Breadth at the bottom</source>
        <translation>底部宽度</translation>
    </message>
    <message>
        <source>Breadth b</source>
        <translation>宽度 b</translation>
    </message>
    <message>
        <source>CN</source>
        <translation>CN（中国）</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>取消</translation>
    </message>
    <message>
        <source>Channel section</source>
        <translation>槽形截面</translation>
    </message>
    <message>
        <source>Clearance of templates</source>
        <translation>样板间隙</translation>
    </message>
    <message>
        <source>Close the panel first, by OK or Cancel</source>
        <translation>请先用“确定”或“取消”关闭面板</translation>
    </message>
    <message>
        <source>Closed ring</source>
        <translation>闭合环</translation>
    </message>
    <message>
        <source>Colour by</source>
        <translation>着色依据</translation>
    </message>
    <message>
        <source>Computing {what}, {done} of {count}; Esc stops</source>
        <translation>正在计算 {what}，{done}/{count}；按 Esc 停止</translation>
    </message>
    <message>
        <source>Contour of bevelled edges</source>
        <translation>坡口边的轮廓</translation>
    </message>
    <message>
        <source>Copy them as well</source>
        <translation>一并复制</translation>
    </message>
    <message>
        <source>Corner joint</source>
        <translation>角部接头</translation>
    </message>
    <message>
        <source>Curvature</source>
        <translation>曲率</translation>
    </message>
    <message>
        <source>Cut</source>
        <translation>分段点</translation>
    </message>
    <message>
        <source>Cut larger by</source>
        <translation>切割加量</translation>
    </message>
    <message>
        <source>Cut of the end</source>
        <translation>终端切割</translation>
    </message>
    <message>
        <source>Cut of the start</source>
        <translation>始端切割</translation>
    </message>
    <message>
        <source>Cut point</source>
        <translation>分段点</translation>
    </message>
    <message>
        <source>Cut {number}: s = {s:.0f} mm</source>
        <translation>分段点 {number}：s = {s:.0f} mm</translation>
    </message>
    <message>
        <source>Delivery pieces</source>
        <translation>运输单元</translation>
    </message>
    <message>
        <source>Development</source>
        <translation>展开</translation>
    </message>
    <message>
        <source>Deviation from a plane</source>
        <translation>偏离平面</translation>
    </message>
    <message>
        <source>Diaphragms and end plates</source>
        <translation>隔板与端板</translation>
    </message>
    <message>
        <source>Diaphragms inside</source>
        <translation>内部隔板</translation>
    </message>
    <message>
        <source>Distance (fit offset)</source>
        <translation>距离（偏移贴合）</translation>
    </message>
    <message>
        <source>Divide the segment</source>
        <translation>在中间分段</translation>
    </message>
    <message>
        <source>Drag a joint, or move it by the left and right arrow keys (Shift: ten times); up and down choose another, double-click or Ins adds one, Del removes it</source>
        <translation>拖动拼接缝，或用左右方向键移动（Shift：十倍）；上下键选择另一条，双击或 Ins 添加，Del 删除</translation>
    </message>
    <message>
        <source>Drag the cut along the axis</source>
        <translation>沿轴线拖动分段点</translation>
    </message>
    <message>
        <source>Drawing sheets</source>
        <translation>图纸</translation>
    </message>
    <message>
        <source>Drawn by</source>
        <translation>绘图</translation>
    </message>
    <message>
        <source>Dropped: {texts}</source>
        <translation>已丢弃：{texts}</translation>
    </message>
    <message>
        <source>EU</source>
        <translation>EU（欧洲）</translation>
    </message>
    <message>
        <source>Each face laid flat; breadths drawn {times:.1f} times as large</source>
        <translation>各面展开图；宽度放大 {times:.1f} 倍</translation>
    </message>
    <message>
        <source>Edit assembly bed</source>
        <translation>编辑胎架</translation>
    </message>
    <message>
        <source>Edit axis</source>
        <translation>编辑轴线</translation>
    </message>
    <message>
        <source>Edit development</source>
        <translation>编辑展开</translation>
    </message>
    <message>
        <source>Edit member</source>
        <translation>编辑构件</translation>
    </message>
    <message>
        <source>Edit node</source>
        <translation>编辑节点</translation>
    </message>
    <message>
        <source>Edit plates</source>
        <translation>编辑板件</translation>
    </message>
    <message>
        <source>Edit section</source>
        <translation>编辑截面</translation>
    </message>
    <message>
        <source>Edit sheets</source>
        <translation>编辑图纸</translation>
    </message>
    <message>
        <source>Edit surface</source>
        <translation>编辑曲面</translation>
    </message>
    <message>
        <source>Ends on it</source>
        <translation>端部落于其上</translation>
    </message>
    <message>
        <source>Errors: {count}</source>
        <translation>错误：{count}</translation>
    </message>
    <message>
        <source>Example project</source>
        <translation>示例项目</translation>
    </message>
    <message>
        <source>Export package</source>
        <translation>导出成果包</translation>
    </message>
    <message>
        <source>Extend the end</source>
        <translation>终端延长</translation>
    </message>
    <message>
        <source>Extend the start</source>
        <translation>始端延长</translation>
    </message>
    <message>
        <source>Face that lies down</source>
        <translation>朝下的面</translation>
    </message>
    <message>
        <source>Files and language</source>
        <translation>文件与语言</translation>
    </message>
    <message>
        <source>Findings</source>
        <translation>检查结果</translation>
    </message>
    <message>
        <source>Findings: {errors} errors, {warnings} warnings, {notes} notes</source>
        <translation>检查结果：{errors} 个错误，{warnings} 个警告，{notes} 个提示</translation>
    </message>
    <message>
        <source>First number</source>
        <translation>起始编号</translation>
    </message>
    <message>
        <source>Fit to the surface</source>
        <translation>与曲面贴合</translation>
    </message>
    <message>
        <source>Flanges full breadth</source>
        <translation>翼缘板通宽</translation>
    </message>
    <message>
        <source>Format</source>
        <translation>图幅</translation>
    </message>
    <message>
        <source>Forming class</source>
        <translation>成形类别</translation>
    </message>
    <message>
        <source>Free list of plates</source>
        <translation>自由板列</translation>
    </message>
    <message>
        <source>FreeCAD document (*.FCStd)</source>
        <translation>FreeCAD 文档 (*.FCStd)</translation>
    </message>
    <message>
        <source>Geometry (*.step *.stp *.iges *.igs *.brep *.brp *.STEP *.STP *.IGES *.IGS)</source>
        <translation>几何文件 (*.step *.stp *.iges *.igs *.brep *.brp *.STEP *.STP *.IGES *.IGS)</translation>
    </message>
    <message>
        <source>Green at the end, mm</source>
        <translation>终端余量，mm</translation>
    </message>
    <message>
        <source>Green at the start, mm</source>
        <translation>始端余量，mm</translation>
    </message>
    <message>
        <source>Half angle</source>
        <translation>半顶角</translation>
    </message>
    <message>
        <source>Half-axis a</source>
        <translation>半轴 a</translation>
    </message>
    <message>
        <source>Half-axis b</source>
        <translation>半轴 b</translation>
    </message>
    <message>
        <source>Half-axis c</source>
        <translation>半轴 c</translation>
    </message>
    <message>
        <source>Height h</source>
        <translation>高度 h</translation>
    </message>
    <message>
        <source>Height points along</source>
        <translation>高度指向</translation>
    </message>
    <message>
        <source>I section</source>
        <translation>工字形截面</translation>
    </message>
    <message>
        <source>ISO</source>
        <translation>ISO</translation>
    </message>
    <message>
        <source>Import schedule</source>
        <translation>导入数据表</translation>
    </message>
    <message>
        <source>Import shapes</source>
        <translation>导入形状</translation>
    </message>
    <message>
        <source>In error: {cells}</source>
        <translation>有错误：{cells}</translation>
    </message>
    <message>
        <source>Joints of each face</source>
        <translation>各面的拼接缝</translation>
    </message>
    <message>
        <source>Joints welded</source>
        <translation>拼接缝焊接</translation>
    </message>
    <message>
        <source>Joints: {count}, against the rules: {broken}</source>
        <translation>拼接缝：{count} 条，其中不合规则：{broken} 条</translation>
    </message>
    <message>
        <source>K</source>
        <translation>K 形</translation>
    </message>
    <message>
        <source>Kept in the member table, not taken: {texts}</source>
        <translation>保留在构件表中，未采用：{texts}</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>种类</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>语言</translation>
    </message>
    <message>
        <source>Language of FreeCAD</source>
        <translation>FreeCAD 的语言</translation>
    </message>
    <message>
        <source>Layers of cut files</source>
        <translation>切割文件的图层</translation>
    </message>
    <message>
        <source>Laying flat by</source>
        <translation>展开方式</translation>
    </message>
    <message>
        <source>Leave them</source>
        <translation>不复制</translation>
    </message>
    <message>
        <source>Left aside, neither faces nor curves: {names}</source>
        <translation>未采用，既非面也非曲线：{names}</translation>
    </message>
    <message>
        <source>Length error</source>
        <translation>长度误差</translation>
    </message>
    <message>
        <source>Length of the stub</source>
        <translation>短牛腿长度</translation>
    </message>
    <message>
        <source>Length {length:.1f} mm, off the surface {off:.4f} mm</source>
        <translation>长度 {length:.1f} mm，距曲面 {off:.4f} mm</translation>
    </message>
    <message>
        <source>Lowest pin above its base</source>
        <translation>最低销高出底座</translation>
    </message>
    <message>
        <source>Lowest seat above the floor</source>
        <translation>最低支座高出地面</translation>
    </message>
    <message>
        <source>Make flush</source>
        <translation>做成齐平</translation>
    </message>
    <message>
        <source>Marked and seen from</source>
        <translation>划线面（视图方向）</translation>
    </message>
    <message>
        <source>Marks on faces</source>
        <translation>面上标记</translation>
    </message>
    <message>
        <source>Measuring lines every</source>
        <translation>测量线间距</translation>
    </message>
    <message>
        <source>Member</source>
        <translation>构件</translation>
    </message>
    <message>
        <source>Member table</source>
        <translation>构件表</translation>
    </message>
    <message>
        <source>Members from selection</source>
        <translation>由选择生成构件</translation>
    </message>
    <message>
        <source>Name of the node</source>
        <translation>节点名称</translation>
    </message>
    <message>
        <source>New objects</source>
        <translation>新对象</translation>
    </message>
    <message>
        <source>New objects start with these. Objects that are there keep their own values, and documents their results.</source>
        <translation>新对象以这些值开始。已有的对象保留自己的值，文档保留其结果。</translation>
    </message>
    <message>
        <source>New sheets and flat patterns start with these; those that are there keep their own.</source>
        <translation>新图纸和展开图以这些值开始；已有的保留自己的值。</translation>
    </message>
    <message>
        <source>Nine points of the section, seen along the axis with the height up</source>
        <translation>截面的九个点，沿轴线看，高度向上</translation>
    </message>
    <message>
        <source>No members yet: {select} makes them, {read} reads them</source>
        <translation>尚无构件：用“{select}”生成，或用“{read}”读入</translation>
    </message>
    <message>
        <source>Node</source>
        <translation>节点</translation>
    </message>
    <message>
        <source>Not copied: {names}. FreeCAD copies what an object depends on, not what depends on it.</source>
        <translation>未复制：{names}。FreeCAD 只复制对象所依赖的内容，不复制依赖于它的内容。</translation>
    </message>
    <message>
        <source>Not kept: {reasons}</source>
        <translation>未保存：{reasons}</translation>
    </message>
    <message>
        <source>Not shown yet: it takes a while; leave the field (Tab)</source>
        <translation>尚未显示：计算需要一些时间；离开该输入框（Tab）后显示</translation>
    </message>
    <message>
        <source>Not taken: {cells}</source>
        <translation>未采用：{cells}</translation>
    </message>
    <message>
        <source>Notes: {count}</source>
        <translation>提示：{count}</translation>
    </message>
    <message>
        <source>Nothing to repair: every object can be computed</source>
        <translation>无需修复：所有对象均可计算</translation>
    </message>
    <message>
        <source>OK</source>
        <translation>确定</translation>
    </message>
    <message>
        <source>Offset along the breadth</source>
        <translation>沿宽度偏移</translation>
    </message>
    <message>
        <source>Offset along the height</source>
        <translation>沿高度偏移</translation>
    </message>
    <message>
        <source>Offset outwards</source>
        <translation>向外偏移</translation>
    </message>
    <message>
        <source>On the axis</source>
        <translation>位于轴线的点</translation>
    </message>
    <message>
        <source>Openings</source>
        <translation>开孔</translation>
    </message>
    <message>
        <source>Order of points</source>
        <translation>点的顺序</translation>
    </message>
    <message>
        <source>Origin x</source>
        <translation>原点 x</translation>
    </message>
    <message>
        <source>Origin y</source>
        <translation>原点 y</translation>
    </message>
    <message>
        <source>Origin z</source>
        <translation>原点 z</translation>
    </message>
    <message>
        <source>Other objects</source>
        <translation>其他对象</translation>
    </message>
    <message>
        <source>Paste</source>
        <translation>粘贴</translation>
    </message>
    <message>
        <source>Per butt joint, mm</source>
        <translation>每条对接缝，mm</translation>
    </message>
    <message>
        <source>Per diaphragm, mm</source>
        <translation>每块隔板，mm</translation>
    </message>
    <message>
        <source>Pick</source>
        <translation>拾取</translation>
    </message>
    <message>
        <source>Pick the cut in 3D</source>
        <translation>在三维视图中选取分段点</translation>
    </message>
    <message>
        <source>Pitch of the pin grid (0: none)</source>
        <translation>销阵间距（0：无）</translation>
    </message>
    <message>
        <source>Plane of the bed</source>
        <translation>胎架平面</translation>
    </message>
    <message>
        <source>Plates</source>
        <translation>板件</translation>
    </message>
    <message>
        <source>Press, then click it in the view or the tree</source>
        <translation>按下后在视图或树中点选</translation>
    </message>
    <message>
        <source>Project</source>
        <translation>项目</translation>
    </message>
    <message>
        <source>Radius R of the ring</source>
        <translation>圆环半径 R</translation>
    </message>
    <message>
        <source>Radius r</source>
        <translation>半径 r</translation>
    </message>
    <message>
        <source>Ranks, property Rank of members: {ranks}</source>
        <translation>等级（构件的属性 Rank）：{ranks}</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>删除</translation>
    </message>
    <message>
        <source>Remove the segment</source>
        <translation>删除该段</translation>
    </message>
    <message>
        <source>Repair document</source>
        <translation>修复文档</translation>
    </message>
    <message>
        <source>Repaired: {count} objects</source>
        <translation>已修复 {count} 个对象</translation>
    </message>
    <message>
        <source>Report</source>
        <translation>报告</translation>
    </message>
    <message>
        <source>Reverse the outward side</source>
        <translation>反转外侧</translation>
    </message>
    <message>
        <source>Roll</source>
        <translation>绕轴转角</translation>
    </message>
    <message>
        <source>Root gap</source>
        <translation>根部间隙</translation>
    </message>
    <message>
        <source>Root gap, left or top</source>
        <translation>根部间隙，左或上</translation>
    </message>
    <message>
        <source>Root gap, right or bottom</source>
        <translation>根部间隙，右或下</translation>
    </message>
    <message>
        <source>Rule pack</source>
        <translation>规则包</translation>
    </message>
    <message>
        <source>Rules</source>
        <translation>规则</translation>
    </message>
    <message>
        <source>Runs through</source>
        <translation>贯通构件</translation>
    </message>
    <message>
        <source>Saddles every</source>
        <translation>托架间距</translation>
    </message>
    <message>
        <source>Schedule (*.xlsx)</source>
        <translation>数据表 (*.xlsx)</translation>
    </message>
    <message>
        <source>Section</source>
        <translation>截面</translation>
    </message>
    <message>
        <source>Segment {number}</source>
        <translation>第 {number} 段</translation>
    </message>
    <message>
        <source>Segment {number}: {section}</source>
        <translation>第 {number} 段：{section}</translation>
    </message>
    <message>
        <source>Sheets</source>
        <translation>图纸</translation>
    </message>
    <message>
        <source>Show</source>
        <translation>显示</translation>
    </message>
    <message>
        <source>Show axis only</source>
        <translation>只显示轴线</translation>
    </message>
    <message>
        <source>Show marks</source>
        <translation>显示编号</translation>
    </message>
    <message>
        <source>Show outer skin</source>
        <translation>显示外表面</translation>
    </message>
    <message>
        <source>Show plates</source>
        <translation>显示板件</translation>
    </message>
    <message>
        <source>Show points</source>
        <translation>显示测点</translation>
    </message>
    <message>
        <source>Shrinkage across, mm/m</source>
        <translation>横向收缩，mm/m</translation>
    </message>
    <message>
        <source>Shrinkage along, mm/m</source>
        <translation>纵向收缩，mm/m</translation>
    </message>
    <message>
        <source>Slope 1 :</source>
        <translation>坡度 1 :</translation>
    </message>
    <message>
        <source>Slope of transitions 1 :</source>
        <translation>过渡坡度 1 :</translation>
    </message>
    <message>
        <source>Split editor</source>
        <translation>分板编辑器</translation>
    </message>
    <message>
        <source>Standard</source>
        <translation>标准</translation>
    </message>
    <message>
        <source>Start from</source>
        <translation>起始于</translation>
    </message>
    <message>
        <source>Station spacing</source>
        <translation>测量线间距</translation>
    </message>
    <message>
        <source>Steel grade</source>
        <translation>钢号</translation>
    </message>
    <message>
        <source>Stock</source>
        <translation>库存板材</translation>
    </message>
    <message>
        <source>Stopped</source>
        <translation>已停止</translation>
    </message>
    <message>
        <source>Strain of laying flat</source>
        <translation>展开应变</translation>
    </message>
    <message>
        <source>Support bundle</source>
        <translation>支持信息包</translation>
    </message>
    <message>
        <source>Support bundle (*.zip)</source>
        <translation>支持信息包 (*.zip)</translation>
    </message>
    <message>
        <source>Surface</source>
        <translation>曲面</translation>
    </message>
    <message>
        <source>Surface laid flat</source>
        <translation>展开的面</translation>
    </message>
    <message>
        <source>T</source>
        <translation>T 形</translation>
    </message>
    <message>
        <source>T section</source>
        <translation>T 形截面</translation>
    </message>
    <message>
        <source>Templates besides at</source>
        <translation>另加样板位置</translation>
    </message>
    <message>
        <source>Templates every</source>
        <translation>样板间距</translation>
    </message>
    <message>
        <source>The faces have their surface already: {surface}</source>
        <translation>所选的面已有曲面：{surface}</translation>
    </message>
    <message>
        <source>The plates do not fit: 2 t must be less than h and b</source>
        <translation>板厚过大：2 t 必须小于 h 和 b</translation>
    </message>
    <message>
        <source>Thickness</source>
        <translation>厚度</translation>
    </message>
    <message>
        <source>Thickness of the bottom (0: t)</source>
        <translation>下翼缘厚度（0：t）</translation>
    </message>
    <message>
        <source>Thickness of the top (0: t)</source>
        <translation>上翼缘厚度（0：t）</translation>
    </message>
    <message>
        <source>Thickness of the webs (0: t)</source>
        <translation>腹板厚度（0：t）</translation>
    </message>
    <message>
        <source>Thickness t</source>
        <translation>厚度 t</translation>
    </message>
    <message>
        <source>Transition</source>
        <translation>过渡段</translation>
    </message>
    <message>
        <source>Transition {length:.0f} mm: {start:.0f} to {end:.0f}</source>
        <translation>过渡段 {length:.0f} mm：{start:.0f} 至 {end:.0f}</translation>
    </message>
    <message>
        <source>Turn the direction</source>
        <translation>反转方向</translation>
    </message>
    <message>
        <source>Twist</source>
        <translation>扭率</translation>
    </message>
    <message>
        <source>Type</source>
        <translation>类型</translation>
    </message>
    <message>
        <source>Type rows, or paste them from a spreadsheet; headings tell what they mean when the mouse is over them</source>
        <translation>逐行输入，或从电子表格粘贴；鼠标停在表头上可看其含义</translation>
    </message>
    <message>
        <source>US</source>
        <translation>US（美国）</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>撤销</translation>
    </message>
    <message>
        <source>Unit</source>
        <translation>单位</translation>
    </message>
    <message>
        <source>Upward direction x, y, z</source>
        <translation>向上方向 x, y, z</translation>
    </message>
    <message>
        <source>Warnings: {count}</source>
        <translation>警告：{count}</translation>
    </message>
    <message>
        <source>Warnings: {count}, listed by Findings</source>
        <translation>警告 {count} 条，见“检查结果”</translation>
    </message>
    <message>
        <source>Webs full height</source>
        <translation>腹板通高</translation>
    </message>
    <message>
        <source>Welds</source>
        <translation>焊缝</translation>
    </message>
    <message>
        <source>Welds are judged once the plates are laid flat (Development)</source>
        <translation>焊缝在板件展开（“展开”命令）后检查</translation>
    </message>
    <message>
        <source>Which runs through</source>
        <translation>由谁贯通</translation>
    </message>
    <message>
        <source>Window</source>
        <translation>窗口</translation>
    </message>
    <message>
        <source>Workbook (*.xlsx);;Report (*.json)</source>
        <translation>工作簿 (*.xlsx);;报告 (*.json)</translation>
    </message>
    <message>
        <source>Write schedule</source>
        <translation>写出数据表</translation>
    </message>
    <message>
        <source>Written without what a schedule cannot say ({count}):</source>
        <translation>已写出，但不含数据表无法表达的内容（{count} 项）：</translation>
    </message>
    <message>
        <source>Written without what is in error:</source>
        <translation>已写出，不含有错误的部分：</translation>
    </message>
    <message>
        <source>Written without what is not laid flat:</source>
        <translation>已写出，不含未展开的部分：</translation>
    </message>
    <message>
        <source>Written: {file}</source>
        <translation>已写出：{file}</translation>
    </message>
    <message>
        <source>Y</source>
        <translation>Y 形</translation>
    </message>
    <message>
        <source>a number is missing or cannot be read</source>
        <translation>缺少数字或无法读取</translation>
    </message>
    <message>
        <source>a value is missing</source>
        <translation>缺少数值</translation>
    </message>
    <message>
        <source>after forming</source>
        <translation>成形后</translation>
    </message>
    <message>
        <source>align</source>
        <translation>对齐</translation>
    </message>
    <message>
        <source>align_to</source>
        <translation>对齐基准</translation>
    </message>
    <message>
        <source>and {count} more</source>
        <translation>另有 {count} 项</translation>
    </message>
    <message>
        <source>and {count} more; the Report view lists them all</source>
        <translation>另有 {count} 项；报告视图中全部列出</translation>
    </message>
    <message>
        <source>at least {limit:.0f}</source>
        <translation>不小于 {limit:.0f}</translation>
    </message>
    <message>
        <source>at most {limit:.0f}</source>
        <translation>不大于 {limit:.0f}</translation>
    </message>
    <message>
        <source>auto</source>
        <translation>自动</translation>
    </message>
    <message>
        <source>automatic</source>
        <translation>自动</translation>
    </message>
    <message>
        <source>axes</source>
        <translation>轴线</translation>
    </message>
    <message>
        <source>axis</source>
        <translation>轴线</translation>
    </message>
    <message>
        <source>before forming</source>
        <translation>成形前</translation>
    </message>
    <message>
        <source>bevels of the edges, as text</source>
        <translation>边缘坡口，文字</translation>
    </message>
    <message>
        <source>bottom</source>
        <translation>下</translation>
    </message>
    <message>
        <source>bottom plate thickness</source>
        <translation>底板厚度</translation>
    </message>
    <message>
        <source>bottom-left</source>
        <translation>左下</translation>
    </message>
    <message>
        <source>bottom-right</source>
        <translation>右下</translation>
    </message>
    <message>
        <source>box1</source>
        <translation>箱形1</translation>
    </message>
    <message>
        <source>box2</source>
        <translation>箱形2</translation>
    </message>
    <message>
        <source>breadth at the bottom</source>
        <translation>底部宽度</translation>
    </message>
    <message>
        <source>centre</source>
        <translation>中心</translation>
    </message>
    <message>
        <source>channel</source>
        <translation>槽形</translation>
    </message>
    <message>
        <source>click a member where the cut is to be, then Cut point</source>
        <translation>先在构件上单击要分段的位置，再选分段点</translation>
    </message>
    <message>
        <source>cold</source>
        <translation>冷弯</translation>
    </message>
    <message>
        <source>concert hall, from its schedule</source>
        <translation>音乐厅（由数据表生成）</translation>
    </message>
    <message>
        <source>cone</source>
        <translation>圆锥面</translation>
    </message>
    <message>
        <source>control points</source>
        <translation>控制点</translation>
    </message>
    <message>
        <source>corner</source>
        <translation>角节点</translation>
    </message>
    <message>
        <source>crossing</source>
        <translation>交点</translation>
    </message>
    <message>
        <source>curvature</source>
        <translation>曲率</translation>
    </message>
    <message>
        <source>curvature comb</source>
        <translation>曲率梳</translation>
    </message>
    <message>
        <source>curve</source>
        <translation>曲线</translation>
    </message>
    <message>
        <source>cut</source>
        <translation>分段点</translation>
    </message>
    <message>
        <source>cylinder</source>
        <translation>圆柱面</translation>
    </message>
    <message>
        <source>deviation</source>
        <translation>偏差</translation>
    </message>
    <message>
        <source>direct</source>
        <translation>直接</translation>
    </message>
    <message>
        <source>edges</source>
        <translation>保边长</translation>
    </message>
    <message>
        <source>elastic</source>
        <translation>弹性</translation>
    </message>
    <message>
        <source>ellipsoid</source>
        <translation>椭球面</translation>
    </message>
    <message>
        <source>en</source>
        <translation>英文</translation>
    </message>
    <message>
        <source>energy</source>
        <translation>最小能量</translation>
    </message>
    <message>
        <source>every member has its sheets already</source>
        <translation>每根构件都已有图纸</translation>
    </message>
    <message>
        <source>expressions (= …) are for the panel of the object</source>
        <translation>表达式（= …）请在对象的面板中输入</translation>
    </message>
    <message>
        <source>face</source>
        <translation>面</translation>
    </message>
    <message>
        <source>fit</source>
        <translation>拟合</translation>
    </message>
    <message>
        <source>fixed</source>
        <translation>固定方向</translation>
    </message>
    <message>
        <source>flanges</source>
        <translation>翼缘</translation>
    </message>
    <message>
        <source>flanges and webs</source>
        <translation>翼缘和腹板</translation>
    </message>
    <message>
        <source>flat</source>
        <translation>平板</translation>
    </message>
    <message>
        <source>fold lines</source>
        <translation>折线</translation>
    </message>
    <message>
        <source>for reference, neither cut nor marked</source>
        <translation>仅供参考，不切割也不划线</translation>
    </message>
    <message>
        <source>forming</source>
        <translation>成形类别</translation>
    </message>
    <message>
        <source>frame ribbon</source>
        <translation>标架带</translation>
    </message>
    <message>
        <source>ft-in</source>
        <translation>英尺-英寸</translation>
    </message>
    <message>
        <source>geodesic</source>
        <translation>测地线</translation>
    </message>
    <message>
        <source>give the node a name</source>
        <translation>请为节点命名</translation>
    </message>
    <message>
        <source>give three numbers: x, y, z</source>
        <translation>请给出三个数：x, y, z</translation>
    </message>
    <message>
        <source>given</source>
        <translation>给定</translation>
    </message>
    <message>
        <source>hot</source>
        <translation>热弯</translation>
    </message>
    <message>
        <source>i</source>
        <translation>工字形</translation>
    </message>
    <message>
        <source>inner</source>
        <translation>内面</translation>
    </message>
    <message>
        <source>inside</source>
        <translation>内侧</translation>
    </message>
    <message>
        <source>iso-curve</source>
        <translation>等参线</translation>
    </message>
    <message>
        <source>it follows = {text}</source>
        <translation>其值随 = {text}</translation>
    </message>
    <message>
        <source>it follows = {text}: change what it names, or clear the expression in the property editor, tab Data</source>
        <translation>其值随 = {text}：请修改其引用的值，或在属性编辑器的“数据”选项卡中清除表达式</translation>
    </message>
    <message>
        <source>it has another unit</source>
        <translation>单位不符</translation>
    </message>
    <message>
        <source>joint of the next face</source>
        <translation>相邻面的拼接缝</translation>
    </message>
    <message>
        <source>joints must be above 0</source>
        <translation>拼接缝位置须大于 0</translation>
    </message>
    <message>
        <source>joints must rise</source>
        <translation>拼接缝位置须递增</translation>
    </message>
    <message>
        <source>joints stand with the first segment</source>
        <translation>拼接缝写在第一段</translation>
    </message>
    <message>
        <source>keep</source>
        <translation>保持</translation>
    </message>
    <message>
        <source>left</source>
        <translation>左</translation>
    </message>
    <message>
        <source>length</source>
        <translation>长度</translation>
    </message>
    <message>
        <source>length error</source>
        <translation>长度误差</translation>
    </message>
    <message>
        <source>level</source>
        <translation>水平</translation>
    </message>
    <message>
        <source>limit</source>
        <translation>限值</translation>
    </message>
    <message>
        <source>linear</source>
        <translation>线性</translation>
    </message>
    <message>
        <source>lines the plate is rolled or pressed along</source>
        <translation>卷制或压制线</translation>
    </message>
    <message>
        <source>link</source>
        <translation>链接</translation>
    </message>
    <message>
        <source>longer plate beside it</source>
        <translation>两侧较长的板</translation>
    </message>
    <message>
        <source>make a section first</source>
        <translation>请先创建截面</translation>
    </message>
    <message>
        <source>make one, or import a schedule</source>
        <translation>请创建一根，或导入数据表</translation>
    </message>
    <message>
        <source>member</source>
        <translation>构件</translation>
    </message>
    <message>
        <source>members</source>
        <translation>构件</translation>
    </message>
    <message>
        <source>mend</source>
        <translation>处理</translation>
    </message>
    <message>
        <source>message</source>
        <translation>内容</translation>
    </message>
    <message>
        <source>mid</source>
        <translation>中面</translation>
    </message>
    <message>
        <source>middle</source>
        <translation>中间</translation>
    </message>
    <message>
        <source>minimal</source>
        <translation>最小旋转</translation>
    </message>
    <message>
        <source>mitre</source>
        <translation>斜接</translation>
    </message>
    <message>
        <source>mm from the start, ratios up to 1, auto, or empty for none</source>
        <translation>距始端 mm、不大于 1 的比例、auto，或留空表示无</translation>
    </message>
    <message>
        <source>move the plane</source>
        <translation>请移动该平面</translation>
    </message>
    <message>
        <source>names and numbers are those of the model</source>
        <translation>名称和编号由模型决定</translation>
    </message>
    <message>
        <source>nearest</source>
        <translation>最近</translation>
    </message>
    <message>
        <source>nearest diaphragm</source>
        <translation>最近的隔板</translation>
    </message>
    <message>
        <source>nearest end of a piece</source>
        <translation>最近的运输段端部</translation>
    </message>
    <message>
        <source>nearest fold</source>
        <translation>最近的折线</translation>
    </message>
    <message>
        <source>nearest node</source>
        <translation>最近的节点</translation>
    </message>
    <message>
        <source>no curve is selected</source>
        <translation>未选择曲线</translation>
    </message>
    <message>
        <source>no curve, no two points and no plane are selected</source>
        <translation>未选择曲线、两个点或平面</translation>
    </message>
    <message>
        <source>no face is selected</source>
        <translation>未选择面</translation>
    </message>
    <message>
        <source>no member has patterns</source>
        <translation>没有构件有展开图</translation>
    </message>
    <message>
        <source>no member is selected</source>
        <translation>未选择构件</translation>
    </message>
    <message>
        <source>no member with patterns is selected</source>
        <translation>未选择有展开图的构件</translation>
    </message>
    <message>
        <source>no member with plates is selected</source>
        <translation>未选择有板件的构件</translation>
    </message>
    <message>
        <source>nodes</source>
        <translation>节点</translation>
    </message>
    <message>
        <source>none</source>
        <translation>无</translation>
    </message>
    <message>
        <source>none, or such as 4000 8000, 0.5, auto</source>
        <translation>无，或如 4000 8000、0.5、auto</translation>
    </message>
    <message>
        <source>normal</source>
        <translation>法向</translation>
    </message>
    <message>
        <source>object</source>
        <translation>对象</translation>
    </message>
    <message>
        <source>offset</source>
        <translation>偏移</translation>
    </message>
    <message>
        <source>offset_y</source>
        <translation>偏移 y</translation>
    </message>
    <message>
        <source>offset_z</source>
        <translation>偏移 z</translation>
    </message>
    <message>
        <source>one member on a dome, with a section change</source>
        <translation>穹顶上的一根变截面构件</translation>
    </message>
    <message>
        <source>openings and slots, to be cut</source>
        <translation>孔和槽，切割</translation>
    </message>
    <message>
        <source>or click the member where the axis is to be</source>
        <translation>或点击构件上轴线应在的位置</translation>
    </message>
    <message>
        <source>outer</source>
        <translation>外面</translation>
    </message>
    <message>
        <source>outer contour, to be cut</source>
        <translation>外轮廓，切割</translation>
    </message>
    <message>
        <source>outside</source>
        <translation>外侧</translation>
    </message>
    <message>
        <source>place</source>
        <translation>位置</translation>
    </message>
    <message>
        <source>plane</source>
        <translation>平面</translation>
    </message>
    <message>
        <source>plane section</source>
        <translation>平面截线</translation>
    </message>
    <message>
        <source>plumb</source>
        <translation>铅垂</translation>
    </message>
    <message>
        <source>point</source>
        <translation>点</translation>
    </message>
    <message>
        <source>points</source>
        <translation>点</translation>
    </message>
    <message>
        <source>polygon</source>
        <translation>多边形</translation>
    </message>
    <message>
        <source>position</source>
        <translation>位置</translation>
    </message>
    <message>
        <source>previous</source>
        <translation>前一段</translation>
    </message>
    <message>
        <source>pull</source>
        <translation>拉到曲面</translation>
    </message>
    <message>
        <source>punch marks</source>
        <translation>冲点</translation>
    </message>
    <message>
        <source>rank</source>
        <translation>等级</translation>
    </message>
    <message>
        <source>ratios up to 1 and mm are mixed</source>
        <translation>比例（不大于 1）与毫米混用</translation>
    </message>
    <message>
        <source>right</source>
        <translation>右</translation>
    </message>
    <message>
        <source>ring</source>
        <translation>环</translation>
    </message>
    <message>
        <source>root</source>
        <translation>根部</translation>
    </message>
    <message>
        <source>row {number}: {reason}</source>
        <translation>第 {number} 行：{reason}</translation>
    </message>
    <message>
        <source>row {row} {column}</source>
        <translation>第 {row} 行 {column}</translation>
    </message>
    <message>
        <source>rows {first} to {last} {column}</source>
        <translation>第 {first} 至 {last} 行 {column}</translation>
    </message>
    <message>
        <source>rule</source>
        <translation>规则</translation>
    </message>
    <message>
        <source>section</source>
        <translation>截面</translation>
    </message>
    <message>
        <source>sections</source>
        <translation>截面</translation>
    </message>
    <message>
        <source>segment</source>
        <translation>段</translation>
    </message>
    <message>
        <source>select a member or its plates</source>
        <translation>请选择构件或其板件</translation>
    </message>
    <message>
        <source>select an axis and a section, or a member to edit</source>
        <translation>请选择轴线和截面，或要编辑的构件</translation>
    </message>
    <message>
        <source>select faces of one shape, or nothing</source>
        <translation>请选择同一形体的面，或不选择</translation>
    </message>
    <message>
        <source>select faces of one shape, or nothing for a dome by its sizes</source>
        <translation>请选择同一形体的面；不选择则按尺寸生成穹顶</translation>
    </message>
    <message>
        <source>select members or their plates</source>
        <translation>请选择构件或其板件</translation>
    </message>
    <message>
        <source>select members with patterns; Development makes them</source>
        <translation>请选择有展开图的构件；展开图由“展开”生成</translation>
    </message>
    <message>
        <source>select members, or have some in the document</source>
        <translation>请选择构件，或在文档中先创建构件</translation>
    </message>
    <message>
        <source>select one axis</source>
        <translation>请选择一条轴线</translation>
    </message>
    <message>
        <source>select one face or surface, then curves, points or a plane face that cuts the surface</source>
        <translation>请选择一个面或曲面，再选择曲线、点或与曲面相交的平面</translation>
    </message>
    <message>
        <source>select one face, then one or more curves on it</source>
        <translation>请选择一个面，再选择其上的一条或多条曲线</translation>
    </message>
    <message>
        <source>select one member or its plates</source>
        <translation>请选择一根构件或其板件</translation>
    </message>
    <message>
        <source>select one member to edit its sheets</source>
        <translation>请选择一根构件以编辑其图纸</translation>
    </message>
    <message>
        <source>select one node</source>
        <translation>请选择一个节点</translation>
    </message>
    <message>
        <source>select one section</source>
        <translation>请选择一个截面</translation>
    </message>
    <message>
        <source>select one surface</source>
        <translation>请选择一个曲面</translation>
    </message>
    <message>
        <source>select one to edit it</source>
        <translation>请选择一个进行编辑</translation>
    </message>
    <message>
        <source>select the member that runs through, then the one that ends on it; or a node to edit</source>
        <translation>请先选择贯通构件，再选择端部落于其上的构件；或选择要编辑的节点</translation>
    </message>
    <message>
        <source>select the node to edit</source>
        <translation>请选择要编辑的节点</translation>
    </message>
    <message>
        <source>severity</source>
        <translation>级别</translation>
    </message>
    <message>
        <source>shorter plate beside it</source>
        <translation>两侧较短的板</translation>
    </message>
    <message>
        <source>slope</source>
        <translation>坡度</translation>
    </message>
    <message>
        <source>smooth</source>
        <translation>光滑</translation>
    </message>
    <message>
        <source>sphere</source>
        <translation>球面</translation>
    </message>
    <message>
        <source>square</source>
        <translation>垂直</translation>
    </message>
    <message>
        <source>station lines and other lines, to be marked</source>
        <translation>测量线及其他线，划线</translation>
    </message>
    <message>
        <source>strain</source>
        <translation>应变</translation>
    </message>
    <message>
        <source>strips</source>
        <translation>板条</translation>
    </message>
    <message>
        <source>stub</source>
        <translation>牛腿</translation>
    </message>
    <message>
        <source>such as {text}</source>
        <translation>如 {text}</translation>
    </message>
    <message>
        <source>surface</source>
        <translation>曲面</translation>
    </message>
    <message>
        <source>surfaces</source>
        <translation>曲面</translation>
    </message>
    <message>
        <source>tee</source>
        <translation>T 形</translation>
    </message>
    <message>
        <source>texts, to be marked</source>
        <translation>文字，打标</translation>
    </message>
    <message>
        <source>the document has no member</source>
        <translation>文档中没有构件</translation>
    </message>
    <message>
        <source>the expression cannot be read: {reason}</source>
        <translation>表达式无法读取：{reason}</translation>
    </message>
    <message>
        <source>the first segment starts with the axis</source>
        <translation>第一段从轴线起点开始</translation>
    </message>
    <message>
        <source>the length is that of the axis, in mm</source>
        <translation>长度为轴线长度，单位 mm</translation>
    </message>
    <message>
        <source>the member chosen above</source>
        <translation>上面所选的构件</translation>
    </message>
    <message>
        <source>the member has no plates</source>
        <translation>该构件没有板件</translation>
    </message>
    <message>
        <source>the member of lower rank</source>
        <translation>等级较低的构件</translation>
    </message>
    <message>
        <source>the plane does not cut the surface</source>
        <translation>该平面与曲面不相交</translation>
    </message>
    <message>
        <source>the table ends before it</source>
        <translation>超出表格范围</translation>
    </message>
    <message>
        <source>there is no member</source>
        <translation>没有构件</translation>
    </message>
    <message>
        <source>there is no section</source>
        <translation>没有截面</translation>
    </message>
    <message>
        <source>there is no section {name!r}; there are {names}</source>
        <translation>没有截面 {name!r}；现有 {names}</translation>
    </message>
    <message>
        <source>thickness</source>
        <translation>厚度</translation>
    </message>
    <message>
        <source>three members on one surface, by planes that cut it</source>
        <translation>同一曲面上由平面截得的三根构件</translation>
    </message>
    <message>
        <source>three members on one surface, with drawing sheets</source>
        <translation>同一曲面上的三根构件，含图纸</translation>
    </message>
    <message>
        <source>top</source>
        <translation>上</translation>
    </message>
    <message>
        <source>top plate thickness</source>
        <translation>顶板厚度</translation>
    </message>
    <message>
        <source>top-left</source>
        <translation>左上</translation>
    </message>
    <message>
        <source>top-right</source>
        <translation>右上</translation>
    </message>
    <message>
        <source>torus</source>
        <translation>圆环面</translation>
    </message>
    <message>
        <source>total</source>
        <translation>总变化</translation>
    </message>
    <message>
        <source>transition</source>
        <translation>过渡方式</translation>
    </message>
    <message>
        <source>transition {length:.0f} mm</source>
        <translation>过渡段 {length:.0f} mm</translation>
    </message>
    <message>
        <source>trapezoid</source>
        <translation>梯形</translation>
    </message>
    <message>
        <source>twist</source>
        <translation>扭率</translation>
    </message>
    <message>
        <source>u</source>
        <translation>u</translation>
    </message>
    <message>
        <source>v</source>
        <translation>v</translation>
    </message>
    <message>
        <source>value</source>
        <translation>实际</translation>
    </message>
    <message>
        <source>web thickness</source>
        <translation>腹板厚度</translation>
    </message>
    <message>
        <source>webs</source>
        <translation>腹板</translation>
    </message>
    <message>
        <source>widest</source>
        <translation>最宽</translation>
    </message>
    <message>
        <source>wire</source>
        <translation>线</translation>
    </message>
    <message>
        <source>with drawing sheets (slower)</source>
        <translation>带图纸（较慢）</translation>
    </message>
    <message>
        <source>without drawing sheets</source>
        <translation>不带图纸</translation>
    </message>
    <message>
        <source>write auto, or numbers such as 4000 8000 or 0.5 1</source>
        <translation>请写 auto，或数字，如 4000 8000 或 0.5 1</translation>
    </message>
    <message>
        <source>zh</source>
        <translation>中文</translation>
    </message>
    <message>
        <source>{count} faces are selected, one is needed</source>
        <translation>已选择 {count} 个面，需要一个</translation>
    </message>
    <message>
        <source>{count} members from M{first} on, cut into plates</source>
        <translation>{count} 根构件，自 M{first} 起编号，并分成板件</translation>
    </message>
    <message>
        <source>{count} members written to {folder}</source>
        <translation>{count} 根构件已写出到 {folder}</translation>
    </message>
    <message>
        <source>{count} pages</source>
        <translation>{count} 页</translation>
    </message>
    <message>
        <source>{count} pages, in the tree below {sheets}</source>
        <translation>{count} 张图纸，位于树中 {sheets} 之下</translation>
    </message>
    <message>
        <source>{count} patterns, lengths within {off:.4f} mm</source>
        <translation>{count} 张展开图，长度误差不超过 {off:.4f} mm</translation>
    </message>
    <message>
        <source>{count} plates, {mass:.0f} kg</source>
        <translation>{count} 块板，{mass:.0f} kg</translation>
    </message>
    <message>
        <source>{count} saddles, lying on: {faces}</source>
        <translation>{count} 个托架，朝下的面：{faces}</translation>
    </message>
    <message>
        <source>{count} selected, two members are needed</source>
        <translation>已选 {count} 个，需要两个构件</translation>
    </message>
    <message>
        <source>{count} shapes are selected, one is needed</source>
        <translation>已选择 {count} 个形体，需要一个</translation>
    </message>
    <message>
        <source>{count} surfaces are selected, one is needed</source>
        <translation>已选择 {count} 个曲面，需要一个</translation>
    </message>
    <message>
        <source>{count} {things} are selected, one is needed</source>
        <translation>已选择 {count} 个{things}，需要一个</translation>
    </message>
    <message>
        <source>{face}: a plate of {length:.0f} mm, at most {limit:.0f}</source>
        <translation>{face}：板件长 {length:.0f} mm，最大 {limit:.0f}</translation>
    </message>
    <message>
        <source>{face}: joint {number} at</source>
        <translation>{face}：拼接缝 {number} 位于</translation>
    </message>
    <message>
        <source>{face}: no joint, Ins adds one</source>
        <translation>{face}：无拼接缝，按 Ins 添加</translation>
    </message>
    <message>
        <source>{file}: {names}; read them before you send them</source>
        <translation>{file}：{names}；发送前请先查看</translation>
    </message>
    <message>
        <source>{kind}, angle {angle:.1f}°, axes {off:.2f} mm apart</source>
        <translation>{kind}，夹角 {angle:.1f}°，轴线相距 {off:.2f} mm</translation>
    </message>
    <message>
        <source>{labels} have it already</source>
        <translation>{labels} 已有</translation>
    </message>
    <message>
        <source>{name} is a member: give the node another name</source>
        <translation>{name} 是构件名：请为节点另取名称</translation>
    </message>
    <message>
        <source>{name} is of no object: write the object before it, as in {example}</source>
        <translation>{name} 不属于任何对象：请在前面写上对象，如 {example}</translation>
    </message>
    <message>
        <source>{one} and {other} have their node already: {nodes}</source>
        <translation>{one} 与 {other} 已有节点：{nodes}</translation>
    </message>
    <message>
        <source>{place:.0f} mm is beyond the member of {length:.0f} mm; between its neighbours: {least:.0f} to {most:.0f} mm</source>
        <translation>{place:.0f} mm 超出长 {length:.0f} mm 的构件；应在相邻拼接缝之间：{least:.0f} 至 {most:.0f} mm</translation>
    </message>
    <message>
        <source>{place:.0f} mm is not between its neighbours: {least:.0f} to {most:.0f} mm</source>
        <translation>{place:.0f} mm 不在相邻拼接缝之间：{least:.0f} 至 {most:.0f} mm</translation>
    </message>
    <message>
        <source>{place:.0f} mm: asked for by sections or pieces, stays where it is</source>
        <translation>{place:.0f} mm：由截面或运输单元要求，位置不变</translation>
    </message>
    <message>
        <source>{position} of the section on the axis; arrow keys move it</source>
        <translation>截面的{position}位于轴线上；用方向键移动</translation>
    </message>
    <message>
        <source>{text!r} is none of {choices}</source>
        <translation>{text!r} 不是 {choices} 之一</translation>
    </message>
    <message>
        <source>{text} adds what has different units</source>
        <translation>{text} 中相加的量单位不同</translation>
    </message>
    <message>
        <source>{text} can mean {whole} or {decimal}: write one of them</source>
        <translation>{text} 可理解为 {whole} 或 {decimal}：请写明其一</translation>
    </message>
    <message>
        <source>{text} cannot be read</source>
        <translation>{text} 无法读取</translation>
    </message>
    <message>
        <source>{text} does not lie behind the start of the axis, 0 mm</source>
        <translation>{text} 不在轴线起点（0 mm）之后</translation>
    </message>
    <message>
        <source>{text} does not lie between 0% and 100%</source>
        <translation>{text} 不在 0% 与 100% 之间</translation>
    </message>
    <message>
        <source>{text} has a unit, a number alone is wanted</source>
        <translation>{text} 带有单位，此处只需数字</translation>
    </message>
    <message>
        <source>{text} has another unit than {unit}</source>
        <translation>{text} 的单位不是 {unit}</translation>
    </message>
    <message>
        <source>{text} is too little: {limit} or more</source>
        <translation>{text} 过小：不小于 {limit}</translation>
    </message>
    <message>
        <source>{text} is too much: {limit} or less</source>
        <translation>{text} 过大：不大于 {limit}</translation>
    </message>
    <message>
        <source>{text}: there are two signs side by side</source>
        <translation>{text}：有两个相连的运算符</translation>
    </message>
    <message>
        <source>{text}: there is no sign between two values</source>
        <translation>{text}：两个值之间缺少运算符</translation>
    </message>
    <message>
        <source>{text}: {number} has no unit, another value has</source>
        <translation>{text}：{number} 没有单位，而另一个值有</translation>
    </message>
    <message>
        <source>{told} (selected: {names})</source>
        <translation>{told}（已选：{names}）</translation>
    </message>
</context>
<context>
    <name>BendTorsion_Alignment</name>
    <message>
        <source>Alignment</source>
        <translation>对齐方式</translation>
    </message>
    <message>
        <source>Which of nine points of the section lies on the axis</source>
        <translation>截面九个点中的哪一个位于轴线上</translation>
    </message>
</context>
<context>
    <name>BendTorsion_AssemblyBed</name>
    <message>
        <source>Assembly bed</source>
        <translation>拼装胎架</translation>
    </message>
    <message>
        <source>What the pieces of the selected members lie on while they are put together</source>
        <translation>所选构件各单元拼装时的支承胎架</translation>
    </message>
</context>
<context>
    <name>BendTorsion_Axis</name>
    <message>
        <source>Axis from selection</source>
        <translation>由选择生成轴线</translation>
    </message>
    <message>
        <source>Select a surface and the edges, wires, sketches or points the member runs along, or a plane face that cuts the surface; or the axis to edit</source>
        <translation>选择曲面以及构件所沿的边、线、草图或点，或与曲面相交的平面；或选择要编辑的轴线</translation>
    </message>
</context>
<context>
    <name>BendTorsion_Check</name>
    <message>
        <source>Check</source>
        <translation>检查</translation>
    </message>
    <message>
        <source>Recompute the document and list everything that is found</source>
        <translation>重新计算文档并列出全部检查结果</translation>
    </message>
</context>
<context>
    <name>BendTorsion_ColourBy</name>
    <message>
        <source>Colour by</source>
        <translation>着色依据</translation>
    </message>
    <message>
        <source>Colour plates by strain, length error, forming class, thickness and more, all selected members on one scale, with a legend</source>
        <translation>按应变、长度误差、成形等级、厚度等为板件着色，所选构件共用一个色标，并带图例</translation>
    </message>
</context>
<context>
    <name>BendTorsion_CutPoint</name>
    <message>
        <source>Click a member where its section is to change: a segment starts there</source>
        <translation>在构件上点击截面变化处：由此开始新的一段</translation>
    </message>
    <message>
        <source>Cut point</source>
        <translation>分段点</translation>
    </message>
</context>
<context>
    <name>BendTorsion_Development</name>
    <message>
        <source>Development</source>
        <translation>展开</translation>
    </message>
    <message>
        <source>Lay the plates of the selected members flat</source>
        <translation>将所选构件的板件展平</translation>
    </message>
</context>
<context>
    <name>BendTorsion_Diaphragms</name>
    <message>
        <source>Diaphragms</source>
        <translation>隔板</translation>
    </message>
    <message>
        <source>Diaphragms and end plates of the selected member</source>
        <translation>所选构件的隔板与端板</translation>
    </message>
</context>
<context>
    <name>BendTorsion_Example</name>
    <message>
        <source>Example project</source>
        <translation>示例项目</translation>
    </message>
    <message>
        <source>Start from an example: one member, three members on a dome, the concert hall</source>
        <translation>从示例开始：一根构件、穹顶上的三根构件、音乐厅</translation>
    </message>
</context>
<context>
    <name>BendTorsion_ExportPackage</name>
    <message>
        <source>Export package</source>
        <translation>导出成果包</translation>
    </message>
    <message>
        <source>Write DXF and NC1 per plate, sheets, STEP, workbook and report into a folder</source>
        <translation>将每块板的 DXF 和 NC1、图纸、STEP、工作簿和报告写入文件夹</translation>
    </message>
</context>
<context>
    <name>BendTorsion_FaceMarks</name>
    <message>
        <source>Marks on faces</source>
        <translation>面上标记</translation>
    </message>
    <message>
        <source>Punches, lines and texts marked on the faces of the member</source>
        <translation>在构件各面上标记的冲点、线和文字</translation>
    </message>
</context>
<context>
    <name>BendTorsion_Findings</name>
    <message>
        <source>All errors, warnings and notes of the document; a click shows the place</source>
        <translation>文档的全部错误、警告和提示；点击即可定位</translation>
    </message>
    <message>
        <source>Findings</source>
        <translation>检查结果</translation>
    </message>
</context>
<context>
    <name>BendTorsion_FitMembers</name>
    <message>
        <source>Fit members</source>
        <translation>适配构件视图</translation>
    </message>
    <message>
        <source>Fit the view to the selected members, without the surface they lie on; to all members when nothing is selected</source>
        <translation>将视图适配到所选构件，不含其所在曲面；未选择时适配到全部构件</translation>
    </message>
</context>
<context>
    <name>BendTorsion_ImportSchedule</name>
    <message>
        <source>A new document with the members of a schedule workbook</source>
        <translation>由数据表工作簿中的构件生成新文档</translation>
    </message>
    <message>
        <source>Import schedule</source>
        <translation>导入数据表</translation>
    </message>
</context>
<context>
    <name>BendTorsion_ImportShapes</name>
    <message>
        <source>Import shapes</source>
        <translation>导入形状</translation>
    </message>
    <message>
        <source>The faces and the curves of a STEP, IGES or BREP file, to select members from</source>
        <translation>读入 STEP、IGES 或 BREP 文件中的面和曲线，以便从中选择构件</translation>
    </message>
</context>
<context>
    <name>BendTorsion_Member</name>
    <message>
        <source>A new member along each selected axis with the selected sections, or the segments of the member selected</source>
        <translation>沿每条所选轴线以所选截面创建构件，或编辑所选构件的各段</translation>
    </message>
    <message>
        <source>Member</source>
        <translation>构件</translation>
    </message>
</context>
<context>
    <name>BendTorsion_MemberTable</name>
    <message>
        <source>All members as a table: sections, cuts, slopes, alignments, offsets and joints, edited or pasted as in a spreadsheet</source>
        <translation>以表格列出全部构件：截面、分段点、坡度、对齐、偏移和拼接缝，可像电子表格一样编辑和粘贴</translation>
    </message>
    <message>
        <source>Member table</source>
        <translation>构件表</translation>
    </message>
</context>
<context>
    <name>BendTorsion_MembersFromSelection</name>
    <message>
        <source>Members from selection</source>
        <translation>由选择生成构件</translation>
    </message>
    <message>
        <source>Select one face, shell or surface and curves on it: each curve becomes a numbered box member that follows the face, cut into plates</source>
        <translation>选择一个面、壳或曲面以及其上的曲线：每条曲线生成一根随面的编号箱形构件，并分成板件</translation>
    </message>
</context>
<context>
    <name>BendTorsion_Node</name>
    <message>
        <source>Node</source>
        <translation>节点</translation>
    </message>
    <message>
        <source>Where the second selected member ends on the first; the node the two have, or the one selected</source>
        <translation>所选第二根构件的端部落于第一根之上；编辑两者已有的节点，或所选的节点</translation>
    </message>
</context>
<context>
    <name>BendTorsion_Openings</name>
    <message>
        <source>Holes and slots in the faces of the member</source>
        <translation>构件各面上的孔和长孔</translation>
    </message>
    <message>
        <source>Openings</source>
        <translation>开孔</translation>
    </message>
</context>
<context>
    <name>BendTorsion_Pieces</name>
    <message>
        <source>Delivery pieces</source>
        <translation>运输单元</translation>
    </message>
    <message>
        <source>Where the member is divided into pieces for transport and site</source>
        <translation>构件按运输和现场分成单元的位置</translation>
    </message>
</context>
<context>
    <name>BendTorsion_Plates</name>
    <message>
        <source>Cut the selected members into plates, or edit the joints of each face</source>
        <translation>将所选构件分成板件，或编辑各面的拼接缝</translation>
    </message>
    <message>
        <source>Plates</source>
        <translation>板件</translation>
    </message>
</context>
<context>
    <name>BendTorsion_Preferences</name>
    <message>
        <source>Preferences</source>
        <translation>偏好设置</translation>
    </message>
    <message>
        <source>What new objects start with; existing documents stay as they are</source>
        <translation>新对象的初始值；已有文档保持不变</translation>
    </message>
</context>
<context>
    <name>BendTorsion_Repair</name>
    <message>
        <source>Make objects compute again that were saved by a FreeCAD without this workbench</source>
        <translation>使被未装本工作台的 FreeCAD 保存过的对象恢复计算</translation>
    </message>
    <message>
        <source>Repair document</source>
        <translation>修复文档</translation>
    </message>
</context>
<context>
    <name>BendTorsion_Report</name>
    <message>
        <source>Report</source>
        <translation>报告</translation>
    </message>
    <message>
        <source>Write the figures of all members as a workbook or JSON file</source>
        <translation>将全部构件的数据写成工作簿或 JSON 文件</translation>
    </message>
</context>
<context>
    <name>BendTorsion_Section</name>
    <message>
        <source>A new section, or the sizes of the one selected</source>
        <translation>新建截面，或编辑所选截面的尺寸</translation>
    </message>
    <message>
        <source>Section</source>
        <translation>截面</translation>
    </message>
</context>
<context>
    <name>BendTorsion_Sheets</name>
    <message>
        <source>Drawing sheets of the selected members; of all when nothing is selected</source>
        <translation>所选构件的图纸；未选择时为全部构件</translation>
    </message>
    <message>
        <source>Sheets</source>
        <translation>图纸</translation>
    </message>
</context>
<context>
    <name>BendTorsion_ShowAs</name>
    <message>
        <source>Plates, skin or axis</source>
        <translation>板件、外表面或轴线</translation>
    </message>
    <message>
        <source>Show plates, outer skin or axis of the selected members, in turn; of all when nothing is selected</source>
        <translation>轮流显示所选构件的板件、外表面或轴线；未选择时为全部构件</translation>
    </message>
</context>
<context>
    <name>BendTorsion_ShowFrames</name>
    <message>
        <source>Show frames</source>
        <translation>显示标架</translation>
    </message>
    <message>
        <source>Show where the height of the section points along the selected axes, or hide it</source>
        <translation>显示或隐藏截面高度沿所选轴线的指向</translation>
    </message>
</context>
<context>
    <name>BendTorsion_ShowMarks</name>
    <message>
        <source>Show marks</source>
        <translation>显示编号</translation>
    </message>
    <message>
        <source>Show the position mark of each plate, or hide it</source>
        <translation>显示或隐藏每块板的位置编号</translation>
    </message>
</context>
<context>
    <name>BendTorsion_ShowPoints</name>
    <message>
        <source>Show points</source>
        <translation>显示测点</translation>
    </message>
    <message>
        <source>Show station lines with their L and P labels, or hide them</source>
        <translation>显示或隐藏测量线及其 L、P 编号</translation>
    </message>
</context>
<context>
    <name>BendTorsion_Splits</name>
    <message>
        <source>Drag the joints of each face on the face laid flat, held against the rules at once</source>
        <translation>在展开的面上拖动各面拼接缝，即时按规则校核</translation>
    </message>
    <message>
        <source>Split editor</source>
        <translation>分板编辑器</translation>
    </message>
</context>
<context>
    <name>BendTorsion_SupportBundle</name>
    <message>
        <source>Support bundle</source>
        <translation>支持信息包</translation>
    </message>
    <message>
        <source>Versions, preferences, findings and tables of the document in one file, for a report of a fault; without names of users, machines and folders</source>
        <translation>把版本、首选项、检查结果和文档表格收入一个文件，用于报告故障；不含用户、机器和文件夹名称</translation>
    </message>
</context>
<context>
    <name>BendTorsion_Surface</name>
    <message>
        <source>Surface</source>
        <translation>曲面</translation>
    </message>
    <message>
        <source>The surface members follow: from selected faces of a shape, or the sizes of the one selected; with nothing selected, a dome, cylinder, cone, torus or plane by its sizes</source>
        <translation>构件所依附的曲面：取自所选形体的面，或编辑所选曲面的尺寸；未选择时，按尺寸生成穹顶、圆柱、圆锥、圆环或平面</translation>
    </message>
</context>
<context>
    <name>BendTorsion_Welds</name>
    <message>
        <source>Preparation, place and tests of seams and joints that differ from the rule pack</source>
        <translation>与规则包不同的焊缝坡口、焊接地点和检验</translation>
    </message>
    <message>
        <source>Welds</source>
        <translation>焊缝</translation>
    </message>
</context>
<context>
    <name>BendTorsion_WriteSchedule</name>
    <message>
        <source>Write schedule</source>
        <translation>写出数据表</translation>
    </message>
    <message>
        <source>Write the members of the document as a schedule workbook</source>
        <translation>将文档中的构件写成数据表工作簿</translation>
    </message>
</context>
<context>
    <name>Workbench</name>
    <message>
        <source>&amp;BendTorsion</source>
        <translation>弯扭构件(&amp;B)</translation>
    </message>
    <message>
        <source>BendTorsion Model</source>
        <translation>弯扭 模型</translation>
    </message>
    <message>
        <source>BendTorsion Output</source>
        <translation>弯扭 输出</translation>
    </message>
    <message>
        <source>BendTorsion Plates</source>
        <translation>弯扭 板件</translation>
    </message>
    <message>
        <source>BendTorsion View</source>
        <translation>弯扭 视图</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>模型</translation>
    </message>
    <message>
        <source>Output</source>
        <translation>输出</translation>
    </message>
    <message>
        <source>Plates</source>
        <translation>板件</translation>
    </message>
    <message>
        <source>Schedule</source>
        <translation>数据表</translation>
    </message>
    <message>
        <source>View</source>
        <translation>视图</translation>
    </message>
</context>
</TS>
