# SPDX-License-Identifier: LGPL-2.1-or-later
"""Findings as sheets tell them: in English as everywhere, in Chinese by their code."""

from __future__ import annotations

import re

from ..finding import Finding, figure_text
from .sheet_style import SheetStyle

FINDINGS_CHINESE: dict[str, str] = {
    "alignment-surface-border": "对齐曲面的边界在此处被越过",
    "axis-ends-meet": "轴线两端几乎相接：应为闭合轴线",
    "axis-far-from-surface": "轴线点远离曲面",
    "axis-foot-ambiguous": "轴线点在曲面上的垂足不唯一",
    "axis-gap": "轴线点之间有间隙",
    "axis-off-surface": "轴线不在曲面上",
    "axis-offset-measured": "轴线到曲面的距离取自给定点",
    "axis-order-ambiguous": "轴线点的次序不明确",
    "axis-past-border": "轴线越过曲面边界",
    "axis-point-moved": "轴线点被移到曲面上",
    "axis-point-twice": "轴线点重复，已略去",
    "axis-points-pulled": "部分轴线点偏离曲面不足 1 mm，已移到曲面上",
    "axis-polyline": "轴线为通过折线顶点的光滑曲线",
    "axis-rms": "轴线偏离曲面超过限值",
    "axis-rule-tolerance": "按规则生成的轴线超出公差",
    "axis-segment-short": "轴线段长度为零，已略去",
    "axis-segment-twice": "轴线段重复，已略去",
    "axis-size": "轴线尺寸可疑，请核对单位",
    "backing-clash": "垫板与隔板相碰，请加大隔板切角",
    "bed-steep": "该面在胎架上过陡，请改换朝下的面",
    "bevel-beyond-head": "坡口角度超过切割头能力",
    "beyond-stock": "板件大于库存钢板，需增加拼接或另行订板",
    "cut-plate-changes": "已切割的板将有改动，请通知车间",
    "diaphragm-gap": "壁板倾斜，隔板方边处角焊缝间隙过大",
    "diaphragm-not-welded": "隔板与壁板间隙过大，未列焊缝",
    "diaphragm-skew": "隔板与壁板夹角过小，不能用角焊缝",
    "end-plate-weld": "端板旁无角焊缝位置，请加大外伸量",
    "joint-beside-diaphragm": "拼接离隔板过近，请移动其一",
    "joint-beside-fold": "拼接离折线过近",
    "joint-beside-node": "拼接离节点过近，请移远",
    "joint-beside-piece-end": "拼接离单元端部过近，请移到端部或移远",
    "joint-in-node": "拼接位于节点范围内",
    "joints-not-staggered": "相邻面的拼接错开距离不足，请移动其一",
    "lane-too-narrow": "分条宽度小于规则",
    "length-error": "展开长度与成形长度之差超过限值，请减小板宽或用 elastic 展开",
    "length-error-bound": "展开长度误差高于可达的最小值，需要时用 elastic 展开",
    "locked-in-stress": "残留应力超过规则限值",
    "members-nearly-touch": "两构件擦肩而过而不相接，请移远或移近",
    "node-blend-nothing": "节点过渡没有可过渡之处",
    "node-branches-near": "两支构件落点过近，相对的焊缝无法施焊",
    "node-diaphragm-access": "节点隔板无法施焊",
    "node-diaphragm-arris": "节点隔板与壁板夹角过小，不设隔板",
    "node-diaphragms-meet": "节点隔板相碰",
    "node-fillet": "节点处夹角过小或过大，不能用角焊缝，改用规则坡口",
    "node-manhole": "节点隔板人孔过小，人员不能通过",
    "node-root-gap": "节点的根部间隙以节点表为准，坡口所写间隙无效",
    "piece-too-short": "板件短于规则允许长度，请移动拼接",
    "preset-held": "预拱未给到轴线端部，端部沿用首末值",
    "root-gap-lanes": "分条之间的根部间隙不从板上扣除",
    "root-gap-whole-seam": "根部间隙沿整条焊缝有效",
    "site-unit": "现场坐标按 mm 读取，请核对单位",
    "smooth-transition-steeper": "光滑过渡段中部坡度最陡",
    "stagger-without-change": "错开量所在处厚度不变",
    "surface-border": "曲面边界在构件范围内",
    "surface-crease": "构件经过曲面的折痕",
    "surface-size": "曲面尺寸可疑，请核对单位",
    "thickness-joints-not-staggered": "变厚处各面拼接错开距离不足",
    "torsion-error": "成形截面相对曲面法线的转角超过限值",
    "transition-short": "过渡段短于规则坡度所需长度",
    "weld-access": "焊缝须在箱内施焊，但箱内净空过小",
}
"""What a warning says, with how to mend it where that is one thing."""
_WORDS = {
    "face": "面",
    "faces": "面",
    "and": "与",
    "edge": "边",
    "saddle": "托架",
    "segment": "段",
    "row": "行",
    "column": "列",
    "point": "点",
    "station": "测站",
    "preset": "预拱",
    "line": "线",
    "lane": "分条",
    "piece": "单元",
    "diaphragm": "隔板",
    "opening": "开孔",
    "weld": "焊缝",
    "seam": "棱缝",
    "top": "上",
    "bottom": "下",
    "left": "左",
    "right": "右",
    "start": "始端",
    "end": "终端",
    "first": "首边",
    "second": "次边",
    "last": "末",
    "at": "在",
    "near": "约",
}
_PHRASES = (
    (r"(\S+) to (\S+) mm along it\b", r"沿边 \1 至 \2 mm"),
    (r"(\S+) to (\S+) mm on the axis\b", r"沿轴线 \1 至 \2 mm"),
    (r"(\S+) to (\S+)", r"\1 至 \2"),
    (r"([^, ][^,]*?) of ([^,]+)", r"\2 的 \1"),
)
"""What places say in more than a word."""
_UNITS = {"deg": "°", "of the width": "板宽"}
_NAMED = (r"\bfaces (\w+) and (\w+)", r"\b(?:face|lane \w+ of face) (\w+)", r"\bweld (\S+)")
"""Faces and welds that a message names."""


def finding_text(finding: Finding, style: SheetStyle) -> str:
    """A finding as one line in the style's language; codes without a Chinese sentence stay as they
    are."""
    if style.language != "zh" or finding.code not in FINDINGS_CHINESE:
        return finding.line(style.told_length).removeprefix(f"{finding.severity}: ")
    named = next((m[0] for own in _NAMED if (m := re.search(own, finding.message))), "")
    places = [finding.object, in_chinese(finding.position)]
    places += [in_chinese(named)] if named not in finding.position else []
    text = f"{'，'.join(place for place in places if place)}：{FINDINGS_CHINESE[finding.code]}"
    unit = _UNITS.get(finding.unit, finding.unit)
    figures = [
        f"{name} {figure_text(float(value), unit, style.told_length)}"
        for name, value in (("实际", finding.value), ("限值", finding.limit))
        if isinstance(value, (int, float))
    ]
    return text + (f"（{'，'.join(figures)}）" if figures else "")


def in_chinese(place: str) -> str:
    """Where a finding is, in Chinese; names and figures as they are."""
    for phrase, chinese in _PHRASES:
        place = re.sub(phrase, chinese, place)
    # Letters of a name beside figures are no words.
    return re.sub(r"(?<![\w-])[a-z]+(?![\w-])", lambda word: _WORDS.get(word[0], word[0]), place)
