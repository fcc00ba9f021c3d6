<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="zh_CN" sourcelanguage="en">
<context>
    <name>App::Property</name>
    <message>
        <source>Frames</source>
        <translation>标架</translation>
    </message>
    <message>
        <source>Height of the ribbon; 0 for one that suits</source>
        <translation>标架带的高度；0 为自动</translation>
    </message>
    <message>
        <source>Labels</source>
        <translation>标注</translation>
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
        <translation>大致位置(相交两次时)</translation>
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
        <source>Contour of bevelled edges</source>
        <translation>坡口边的轮廓</translation>
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
        <translation>末端切割</translation>
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
        <translation>分段点 {number}:s = {s:.0f} mm</translation>
    </message>
    <message>
        <source>Delivery pieces</source>
        <translation>运输节段</translation>
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
        <translation>拖动接缝,或用左右方向键移动(Shift:十倍);上下键选择另一条,双击或 Ins 添加,Del 删除</translation>
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
        <source>EU</source>
        <translation>EU（欧洲）</translation>
    </message>
    <message>
        <source>Each face laid flat; breadths drawn {times:.1f} times as large</source>
        <translation>各面展开图;宽度放大 {times:.1f} 倍</translation>
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
        <source>Example project</source>
        <translation>示例项目</translation>
    </message>
    <message>
        <source>Export package</source>
        <translation>导出成果包</translation>
    </message>
    <message>
        <source>Extend the end</source>
        <translation>末端延长</translation>
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
        <source>FreeCAD document (*.FCStd)</source>
        <translation>FreeCAD 文档 (*.FCStd)</translation>
    </message>
    <message>
        <source>Geometry (*.step *.stp *.iges *.igs *.brep *.brp *.STEP *.STP *.IGES *.IGS)</source>
        <translation>几何文件 (*.step *.stp *.iges *.igs *.brep *.brp *.STEP *.STP *.IGES *.IGS)</translation>
    </message>
    <message>
        <source>Green at the end, mm</source>
        <translation>末端余量,mm</translation>
    </message>
    <message>
        <source>Green at the start, mm</source>
        <translation>起端余量,mm</translation>
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
        <source>Joints of each face</source>
        <translation>各面的接缝</translation>
    </message>
    <message>
        <source>Joints welded</source>
        <translation>接缝焊接</translation>
    </message>
    <message>
        <source>K</source>
        <translation>K 形</translation>
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
        <translation>划线面(视图方向)</translation>
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
        <translation>新对象以这些值开始。已有的对象保留自己的值,文档保留其结果。</translation>
    </message>
    <message>
        <source>New sheets and flat patterns start with these; those that are there keep their own.</source>
        <translation>新图纸和展开图以这些值开始;已有的保留自己的值。</translation>
    </message>
    <message>
        <source>Node</source>
        <translation>节点</translation>
    </message>
    <message>
        <source>Not taken: {cells}</source>
        <translation>未采用：{cells}</translation>
    </message>
    <message>
        <source>Nothing to repair: every object can be computed</source>
        <translation>无需修复：所有对象均可计算</translation>
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
        <source>Per butt joint, mm</source>
        <translation>每条对接缝,mm</translation>
    </message>
    <message>
        <source>Per diaphragm, mm</source>
        <translation>每块隔板,mm</translation>
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
        <translation>销阵间距(0:无)</translation>
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
        <translation>横向收缩,mm/m</translation>
    </message>
    <message>
        <source>Shrinkage along, mm/m</source>
        <translation>纵向收缩,mm/m</translation>
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
        <source>Templates besides at</source>
        <translation>另加样板位置</translation>
    </message>
    <message>
        <source>Templates every</source>
        <translation>样板间距</translation>
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
        <source>Unit</source>
        <translation>单位</translation>
    </message>
    <message>
        <source>Upward direction x, y, z</source>
        <translation>向上方向 x, y, z</translation>
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
        <source>Which runs through, by</source>
        <translation>贯通构件的确定方式</translation>
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
        <source>Written without what is in error:</source>
        <translation>已写出，不含有错误的部分：</translation>
    </message>
    <message>
        <source>Written: {file}</source>
        <translation>已写出：{file}</translation>
    </message>
    <message>
        <source>Written: {file}; {count} things a schedule cannot say</source>
        <translation>已写出：{file}；有 {count} 项数据表无法表达</translation>
    </message>
    <message>
        <source>Y</source>
        <translation>Y 形</translation>
    </message>
    <message>
        <source>a cut lies behind the start of the axis</source>
        <translation>分段点须位于轴线起点之后</translation>
    </message>
    <message>
        <source>a cut lies between 0% and 100%</source>
        <translation>分段点须在 0% 与 100% 之间</translation>
    </message>
    <message>
        <source>a number is missing or cannot be read</source>
        <translation>缺少数字或无法读取</translation>
    </message>
    <message>
        <source>a slope is 0 or more</source>
        <translation>坡度须不小于 0</translation>
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
        <source>at least {limit:.0f}</source>
        <translation>不小于 {limit:.0f}</translation>
    </message>
    <message>
        <source>at most {limit:.0f}</source>
        <translation>不大于 {limit:.0f}</translation>
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
        <source>between its neighbours: {least:.0f} to {most:.0f} mm</source>
        <translation>应在相邻接缝之间:{least:.0f} 至 {most:.0f} mm</translation>
    </message>
    <message>
        <source>bottom</source>
        <translation>下</translation>
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
        <source>centre</source>
        <translation>中心</translation>
    </message>
    <message>
        <source>channel</source>
        <translation>槽形</translation>
    </message>
    <message>
        <source>click a member where the cut is to be</source>
        <translation>单击构件上要分段的位置</translation>
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
        <source>give three numbers: x, y, z</source>
        <translation>请给出三个数:x, y, z</translation>
    </message>
    <message>
        <source>given</source>
        <translation>给定</translation>
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
        <source>it has another unit</source>
        <translation>单位不符</translation>
    </message>
    <message>
        <source>joint of the next face</source>
        <translation>相邻面的接缝</translation>
    </message>
    <message>
        <source>joints must be above 0</source>
        <translation>接缝位置须大于 0</translation>
    </message>
    <message>
        <source>joints must rise</source>
        <translation>接缝位置须递增</translation>
    </message>
    <message>
        <source>joints stand with the first segment</source>
        <translation>接缝写在第一段</translation>
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
        <source>length error</source>
        <translation>长度误差</translation>
    </message>
    <message>
        <source>level</source>
        <translation>水平</translation>
    </message>
    <message>
        <source>linear</source>
        <translation>线性</translation>
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
        <source>none; 4000 8000; 0.5; auto</source>
        <translation>无；4000 8000；0.5；auto</translation>
    </message>
    <message>
        <source>normal</source>
        <translation>法向</translation>
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
        <source>or click the member where the axis is to be</source>
        <translation>或点击构件上轴线应在的位置</translation>
    </message>
    <message>
        <source>outer</source>
        <translation>外面</translation>
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
        <source>previous</source>
        <translation>前一段</translation>
    </message>
    <message>
        <source>pull</source>
        <translation>拉到曲面</translation>
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
        <translation>第 {number} 行:{reason}</translation>
    </message>
    <message>
        <source>row {row} {column}</source>
        <translation>第 {row} 行 {column}</translation>
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
        <source>the document has no member</source>
        <translation>文档中没有构件</translation>
    </message>
    <message>
        <source>the expression cannot be read: {reason}</source>
        <translation>表达式无法读取:{reason}</translation>
    </message>
    <message>
        <source>the first segment starts with the axis</source>
        <translation>第一段从轴线起点开始</translation>
    </message>
    <message>
        <source>the member has no plates</source>
        <translation>该构件没有板件</translation>
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
        <source>there is no section {name!r}</source>
        <translation>没有截面 {name!r}</translation>
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
        <translation>带图纸(较慢)</translation>
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
        <source>{count} joints, {broken} of them against the rules</source>
        <translation>{count} 条接缝,其中 {broken} 条违反规则</translation>
    </message>
    <message>
        <source>{count} members are selected, two are needed</source>
        <translation>已选择 {count} 根构件，需要两根</translation>
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
        <source>{count} patterns, lengths within {off:.4f} mm</source>
        <translation>{count} 张展开图,长度误差不超过 {off:.4f} mm</translation>
    </message>
    <message>
        <source>{count} plates, {mass:.0f} kg</source>
        <translation>{count} 块板，{mass:.0f} kg</translation>
    </message>
    <message>
        <source>{count} saddles, lying on: {faces}</source>
        <translation>{count} 个托架,朝下的面:{faces}</translation>
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
        <source>{face}: joint {number} at</source>
        <translation>{face}:接缝 {number} 位于</translation>
    </message>
    <message>
        <source>{file}: {names}; read them before you send them</source>
        <translation>{file}：{names}；发送前请先查看</translation>
    </message>
    <message>
        <source>{kind}, angle {angle:.1f}°, axes {off:.2f} mm apart</source>
        <translation>{kind},夹角 {angle:.1f}°,轴线相距 {off:.2f} mm</translation>
    </message>
    <message>
        <source>{labels} have it already</source>
        <translation>{labels} 已有</translation>
    </message>
    <message>
        <source>{one} and {other} have their node already: {nodes}</source>
        <translation>{one} 与 {other} 已有节点：{nodes}</translation>
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
        <source>{text!r} is not a number</source>
        <translation>{text!r} 不是数字</translation>
    </message>
    <message>
        <source>{text!r} is not a number of use</source>
        <translation>{text!r} 不是可用的数字</translation>
    </message>
    <message>
        <source>{text} cannot be read</source>
        <translation>{text} 无法读取</translation>
    </message>
    <message>
        <source>{text} has another unit than {unit}</source>
        <translation>{text} 的单位不是 {unit}</translation>
    </message>
    <message>
        <source>{text} is not between {least:g} and {most:g} {unit}</source>
        <translation>{text} 不在 {least:g} 与 {most:g} {unit} 之间</translation>
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
        <translation>所选构件各节段拼装时的支承胎架</translation>
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
        <translation>以表格列出全部构件：截面、分段点、坡度、对齐、偏移和接缝，可像电子表格一样编辑和粘贴</translation>
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
        <translation>运输节段</translation>
    </message>
    <message>
        <source>Where the member is divided into pieces for transport and site</source>
        <translation>构件按运输和现场分成节段的位置</translation>
    </message>
</context>
<context>
    <name>BendTorsion_Plates</name>
    <message>
        <source>Cut the selected members into plates, or edit the joints of each face</source>
        <translation>将所选构件分成板件，或编辑各面的接缝</translation>
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
        <translation>在展开的面上拖动各面接缝,即时按规则校核</translation>
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
