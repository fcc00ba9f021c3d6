# SPDX-License-Identifier: LGPL-2.1-or-later
"""The labels of sheets in Chinese, by their English text; `{}` stands for a value in both."""

from __future__ import annotations

_TITLES = {
    "project": "项目",
    "sheet": "图号",
    "scale": "比例",
    "member": "构件",
    "sections": "截面",
    "sections, mm": "截面，mm",
    "content": "内容",
    "plates on this sheet": "本图板件",
    "projection": "投影",
    "material": "材料",
    "member mass (net)": "构件净重",
    "units": "单位",
    "mm": "mm",
    "ft-in; tables in; t: in (mm)": "ft-in；表 in；t：in (mm)",
    "drawing": "图纸编号",
    "drawing of": "图名",
    "extent": "范围",
    "members on this sheet": "本图构件",
    "total mass (net)": "总净重",
    "{}, see the list": "{} 块，见表",
    "software": "软件",
    "drawn": "制图",
    "checked": "校核",
    "approved": "批准",
    "date": "日期",
    "revision": "版次",
    "to": "至",
    "continued": "续",
}
_HEADINGS = {
    "general arrangement": "总布置图",
    "plan and elevation": "平面与立面",
    "members": "构件表",
    "overview": "总览",
    "assembly": "组装图",
    "assembly P{}": "组装图 P{}",
    "sections and welds": "截面与焊缝",
    "sections and welds P{}": "截面与焊缝 P{}",
    "plates": "板件数",
    "flat patterns": "板件展开",
    "flat parts": "平板零件",
    "plate list": "板件表",
    "figures": "数据",
    "bed plan {}": "胎架图 {}",
    "bed {}: {}": "胎架 {}：{}",
    "seats": "支点",
    "control points": "控制点",
    "control points on the site": "控制点现场坐标",
    "site {}, {}": "现场 {}，{}",
    "pins": "顶针",
    "in error": "有错误",
    "{}: IN ERROR, NOT DRAWN": "{}：有错误，未绘图",
    "Elevation": "立面",
    "Plan": "平面",
    "Members": "构件",
    "{} members": "{} 根构件",
    "N": "北",
    "TOP": "上",
    "CG": "重心",
    "Welds and joints": "焊缝与拼接",
    "Welds at {}": "焊缝 {}",
    "end": "端",
    "fold": "折线",
    "mid-length": "跨中",
}
_COLUMNS = {
    "length": "长度",
    "width": "宽度",
    "mass, kg": "质量 kg",
    "pieces": "运输单元",
    "CG on the site, {}": "现场坐标重心 {}",
    "CG in the model, {}": "模型坐标重心 {}",
    "site datum": "现场基准",
    "model origin, {}": "模型原点 {}",
    "rotation, °": "转角 °",
    "x": "x",
    "y": "y",
    "z": "z",
    "s": "s",
    "u": "u",
    "v": "v",
    "t": "t",
    "t, in (mm)": "t，in (mm)",
    "mark": "编号",
    "max error": "最大误差",
    "strain, %": "应变 %",
    "Plates (length error of edges, lines and diagonals, mm; net mass)": (
        "板件（边、线、对角线长度误差 mm；净质量）"
    ),
    "figure": "项目",
    "value": "数值",
    "length on the axis": "轴线长度",
    "axis to surface, rms": "轴线到曲面均方根",
    "net mass": "净质量",
    "axis to surface, max": "轴线到曲面最大",
    "torsion error, max": "扭转误差最大",
    "section type": "截面类型",
    "total torsion": "总扭转",
    "Warnings ({})": "警告（{}）",
    "and {} more: see the Checks of results.xlsx": "另有 {} 条：见 results.xlsx 的 Checks",
    "piece": "单元",
    "from": "自",
    "starts": "起端",
    "ends": "终端",
    "gap": "间隙",
    "parts": "零件数",
    "centre x, y, z": "重心 x, y, z",
    "centre x, y, z, in": "重心 x, y, z，in",
    "stepped": "错开",
    "square": "直边",
    "open {}° marked face": "划线面开口 {}°",
    "open {}° other face": "背面开口 {}°",
    "step": "突变",
    "zone": "区段",
    "folds": "折线",
    "fold, s": "折线 s",
    "{}, °": "{} °",
    "height left": "左高",
    "height right": "右高",
    "Assembly bed {}: {} face down, heights above the floor, {}": (
        "胎架 {}：{}面朝下，离地高度 {}"
    ),
    "group": "组",
    "slope": "坡度",
    "d top": "d 上",
    "d bottom": "d 下",
    "d left": "d 左",
    "d right": "d 右",
}
_PLATES = {
    "net {}, {} kg": "净 {}，{} kg",
    "gross {}, {} kg": "毛 {}，{} kg",
    "mid-surface": "中面",
    "outer face": "外表面",
    "inner face": "内表面",
    "marking face": "划线面",
    "root of the grooves": "坡口根部",
    "widest outline of the edges": "边缘最大轮廓",
    "out of flat": "平面偏差",
    "radius": "半径",
    "membrane stress": "薄膜应力",
    "bending stress": "弯曲应力",
    "fold angle": "折角",
    "none": "无",
    "tilt, °": "倾斜 °",
    "quantity {}": "数量 {}",
    "part {}": "零件 {}",
    "opposite hand of {}": "与 {} 镜像",
    "face {}": "面 {}",
    "marking face: {}, up": "划线面：{}（朝上）",
    "rolling direction along u": "轧制方向沿 u",
    "labels left out: {}, see sheet {}": "未标注 {} 个，见图 {}",
    "points, stations and roll lines are named in the details on sheet {}": (
        "点、测站线与卷板线见图 {} 的详图"
    ),
    "flat patterns: details": "板件展开详图",
    "detail {} to {}": "详图 {} 至 {}",
    "at": "位于",
    "{} over the ends": "总长 {}",
    "slot {}": "长圆孔 {}",
    "manhole {}": "人孔 {}",
    "forming: {}": "成形：{}",
    "twist {}°/m": "扭转 {}°/m",
    "locked-in stress {} MPa": "残留应力 {} MPa",
    "press at the folds": "折线处压弯",
    "pre-form": "预成形",
    "R min {} m": "最小半径 {} m",
    "clamp with {} kN at mid-length": "跨中夹紧力 {} kN",
    "clamp with {} kN at each free corner": "每个自由角夹紧力 {} kN",
    "may stay flat": "可保持平板",
    "drops in": "自重就位",
    "cold": "冷弯",
    "hot": "热弯",
    "elastic": "弹性",
    "up": "向上",
    "down": "向下",
    "inside": "内侧",
    "outside": "外侧",
    "left": "左",
    "right": "右",
    "top": "上",
    "bottom": "下",
    "diaphragm": "隔板",
    "point": "点",
    "line": "线",
    "edge": "边",
    "meets": "相邻",
    "s from": "s 自",
    "s to": "s 至",
    "u from": "u 自",
    "u to": "u 至",
    "dihedral, °": "二面角 °",
    "{}: points, {}": "{}：点，{}",
    "{}: edges, {}": "{}：边，{}",
    "{}: panels, before and after forming, {}": "{}：分格，成形前后，{}",
    "panel": "分格",
    "state": "状态",
    "flat": "平面",
    "formed": "成形",
    "chord": "弦长",
    "diagonal": "对角线",
    "land": "钝边",
}
_WELDS = {
    "weld": "焊缝",
    "prep": "坡口号",
    "type": "型式",
    "angle, °": "角度 °",
    "side": "坡口面",
    "place": "场所",
    "NDT": "无损检测",
    "groove, °": "坡口角 °",
    "cut / on": "开坡口板 / 相邻板",
    "symbol": "符号",
    "depth": "深度",
    "backing": "衬垫",
    "total": "合计",
    "in all {}": "总长 {}",
    "Welds and joints (mm)": "焊缝与拼接（mm）",
    "Kinds of welds (mm)": "焊缝种类（mm）",
    "Kinds of welds": "焊缝种类",
    "Backing bars (not in the mass of the member)": "衬垫条（不计入构件质量）",
    "Weld map": "焊缝布置图",
    "Weld map (continued)": "焊缝布置图（续）",
    "s {} to {}, +s to the right; face: plates and joints; seam: welds": (
        "s {} 至 {}，+s 向右；面：板件与拼接；棱缝：焊缝"
    ),
    "bevel": "单边坡口",
    "chamfer": "削斜",
    "V": "V 形",
    "double-fillet": "双面角焊",
    "double-bevel": "K 形",
    "double-v": "X 形",
    "fillet": "角焊",
    "slot": "槽焊",
    "outer": "外",
    "inner": "内",
    "shop": "工厂",
    "field": "现场",
}
_BEDS = {
    "saddle": "托架",
    "left x": "左 x",
    "left y": "左 y",
    "left height": "左高",
    "right x": "右 x",
    "right y": "右 y",
    "right height": "右高",
    "slope, °": "坡度 °",
    "stop": "挡块",
    "stop x": "挡块 x",
    "stop y": "挡块 y",
    "stop height": "挡块高",
    "corner": "角点",
    "bed x": "胎架 x",
    "bed y": "胎架 y",
    "bed z": "胎架 z",
    "column": "列",
    "row": "行",
    "height": "高度",
    "tilt, °": "倾角 °",
    "bed in the model": "胎架在模型中",
    "origin, {}": "原点 {}",
    "{} axis": "{} 轴",
    "floor 0": "地面 0",
    "{} on its bed: plan": "{} 胎架平面",
    "{} on its bed: elevation": "{} 胎架立面",
    "Seats ({}, on the bed; heights above the floor)": "支点（{}，胎架坐标；离地高度）",
    "Control points ({})": "控制点（{}）",
    "best plane of its edges": "边线最佳平面",
    "its plane at mid-length": "跨中平面",
    "plane by given direction": "给定方向的平面",
    "Pins (crosses): base {} above the floor.": "顶针（十字）：底座离地 {}。",
}
_NOTES = {
    "Face {} lies down; bed by {}, its edges within ±{}. Plan seen from above; left is up. "
    "Bar: saddle with its seats; triangle: side stop at the lower seat. Elevation: heights of "
    "the left and the right seat above the floor. Templates: {}.": (
        "{} 面朝下；胎架按{}，边线偏差 ±{}。平面为俯视，左侧在上。横杆：托架及支点；三角："
        "低侧挡块。"
        "立面：左右支点离地高度。样板：{}。"
    ),
    "x, y, z: model coordinates. bed x, y, z: on the bed, floor at 0. Outer corners of the "
    "section at the member's stations and the piece's ends, {}.": (
        "x, y, z：模型坐标。胎架 x, y, z：地面为 0。构件测站与单元端部的截面外角点，{}。"
    ),
    "x, y: on the bed, {}. height: above the base of the pins. tilt: of the face there.": (
        "x, y：胎架坐标，{}。高度：自顶针底座。倾角：该处面的倾角。"
    ),
    "Patterns show the net plate before forming, its {} laid flat, seen from the marking face, "
    "which is up. u runs right and v up from the cross at the lower left corner of each pattern's "
    "bounding box. L: station line, E: end line, P: point, small cross: witness mark W, F "
    "(dashed): fold line with its angle, up towards the eye or down, R (chain): roll line of a "
    "plate to be rolled, with its radius, O: opening with u, v of its middle. Dimensions are "
    "overall, before forming. Cut files draw the contour of the {}, with allowances where the "
    "gross size differs.": (
        "展开图为成形前净尺寸，按{}展开，自划线面看，划线面朝上。u 向右、v 向上，原点为包围框左下"
        "角的十字。L：测站线；E：端线；P：点；小十字：基准点 W；F（虚线）：折线及角度，向上为朝向观"
        "者；R（点画线）：卷板线及半径；O：开孔及中心 u, v。尺寸为成形前总尺寸。切割文件按{}轮廓，"
        "毛尺寸不同者含余量。"
    ),
    "Points: s: arc length on the axis; x, y, z: model coordinates; u, v: flat pattern; P: on the "
    "outer face's corner line; W: on the marking face, inside the edge. Panels: flat: before "
    "forming; formed: after forming, along the surface; chord: after forming, straight between "
    "the points P. Edges: grooves by angle against square and depth, +: face cut back; tilt: of "
    "the edge without grooves against square, +: outer face wider; a row for each stretch of one "
    "bevel: s, u: where it begins and ends on the axis and on the pattern, of E lines along the "
    "line from the first edge; chamfer 1:n × d: machined off that face after cutting, d deep at "
    "the edge and running out over n × d.": (
        "点：s 为轴线弧长；x, y, z 为模型坐标；u, v 为展开坐标；P 在外表面角线上；W 在划线面上、边"
        "缘内侧。分格：平面为成形前；成形为成形后沿曲面；弦长为成形后 P 点间直线。边：坡口为相对直"
        "角的角度与深度，正为该面切去；倾斜为未开坡口边面相对直角的角度，正为外表面较宽；每段"
        "同一坡口一行：s、u 为其起止处的轴线弧长与展开坐标，E 线为自第一边沿线的距离；"
        "削斜 1:n × d：切割后在该面加工，边缘处深 d，长 n × d。"
    ),
    "Springback is left to the shop: radii and angles are of the finished plate.": (
        "回弹由工厂考虑：半径与角度为成品值。"
    ),
    "Sections are seen along +s, up as the section's z axis; cross: the axis, to which dimensions "
    "are given. Weld symbols: the arrow points at the outer face of the plate that is cut; welds "
    "without a depth go through the whole plate. t: thickness, {}.": (
        "截面沿 +s 方向看，上方为截面 z 轴；十字为轴线，尺寸自轴线标注。焊缝符号：箭头指向开坡口板"
        "的外表面；未注深度者为全熔透。t：板厚 {}。"
    ),
}
_NODES = {
    "node {}": "节点 {}",
    "Node {}: {}, {} runs through": "节点 {}：{}，{} 贯通",
    "crossing": "交叉",
    "Place": "位置",
    "system": "坐标系",
    "model, {}": "模型，{}",
    "site, {}": "现场，{}",
    "branch": "支构件",
    "s of through": "贯通构件 s",
    "axes apart": "轴线距",
    "direct": "直接",
    "stub": "短牛腿",
    "root gap": "根部间隙",
    "root gap {}": "根部间隙 {}",
    "field joint, stub {}": "现场接头，牛腿 {}",
    "lands on": "落于面",
    "Flange steps, {}": "翼缘错台，{}",
    "side of node": "节点侧",
    "before": "前",
    "behind": "后",
    "face": "面",
    "against": "对照面",
    "limit": "限值",
    "limit, °": "限值 °",
    "rule": "规则",
    "kept": "符合",
    "broken": "超限",
    "not in line": "不对齐",
    "Plates that end at the node": "止于节点的板件",
    "plate": "板件",
    "cut length": "切口长",
    "angle of cut, °": "切口角 °",
    "snipes": "切角",
    "openings": "开孔",
    "weld length": "焊缝长",
    "Places of diaphragms from the node": "内隔板位置（自节点）",
    "on face": "所落面",
    "Diaphragms inside": "内隔板",
    "Welds": "焊缝",
    "preparation": "坡口",
    "Along the surface normal, from outside": "沿曲面法线，自外侧看",
    "Along {}, +s away": "沿 {} 的 +s 方向看",
    "No room for the marks {}.": "无处标注：{}。",
    "Views show plates by the edges of their outer faces; broken: diaphragms; wide: cuts at the "
    "node. Side of node: before or behind it along the branch. Step: of the branch's face over "
    "that of the member that runs through; held against the rule where both plates are in line. "
    "Angle of cut: of the end as it lies on the face, without its groove, against square, at its "
    "two corners, positive where the outer face is the longer. Dihedral: between plate and face "
    "on the inner side. Places of diaphragms: the middle of each side at mid-thickness, from the "
    "node, x along the member that runs through, y to the left, z outwards. Symbols: one for each "
    "kind of weld, its letter in the tail.": (
        "视图为各板外表面边线；虚线：隔板；粗线：节点处切口。节点侧：沿支构件在节点之前或之后。错台："
        "支构件面高出贯通构件面的量，仅两板对齐时按规则核对。切口角：不计坡口，切口两端相对直角的角度，"
        "外表面较长为正。二面角：板与所落面的内侧夹角。隔板位置：各边中点（板厚中面）自节点起，"
        "x 沿贯通构件，y 向左，z 向外。焊缝符号：每种一个，尾部为其字母。"
    ),
}
PREPARATIONS = {
    "corner": "角接",
    "butt": "对接",
    "branch": "相贯",
    "diaphragm": "隔板",
    "end plate": "端板",
    "slot": "槽焊",
    "skew": "斜接",
}
"""The names rule packs give preparations; those of a schedule stay as they are."""
CHINESE: dict[str, str] = {
    **_TITLES,
    **_HEADINGS,
    **_COLUMNS,
    **_PLATES,
    **_WELDS,
    **_BEDS,
    **_NODES,
    **_NOTES,
}
