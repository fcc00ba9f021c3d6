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
    "axis-order-ambiguous": "轴线点的次序不明确",
    "axis-past-border": "轴线越过曲面边界",
    "axis-point-moved": "轴线点被移到曲面上",
    "axis-rule-tolerance": "按规则生成的轴线超出公差",
    "axis-size": "轴线尺寸可疑，请核对单位",
    "backing-clash": "垫板与隔板相碰，请加大隔板切角",
    "bevel-beyond-head": "坡口角度超过切割头能力",
    "beyond-stock": "板件大于库存钢板，需增加拼接或另行订板",
    "diaphragm-gap": "壁板倾斜，隔板方边处角焊缝间隙过大",
    "diaphragm-not-welded": "隔板与壁板间隙过大，未列焊缝",
    "diaphragm-skew": "隔板与壁板夹角过小，不能用角焊缝",
    "end-plate-weld": "端板旁无角焊缝位置，请加大外伸量",
    "joint-beside-fold": "拼接离折线过近",
    "joint-in-node": "拼接位于节点范围内",
    "joints-not-staggered": "相邻面的拼接错开距离不足，请移动其一",
    "lane-too-narrow": "分条宽度小于规则",
    "locked-in-stress": "残留应力超过规则限值",
    "node-blend-nothing": "节点过渡没有可过渡之处",
    "node-branches-near": "两支构件落点过近，相对的焊缝无法施焊",
    "node-diaphragm-access": "节点隔板无法施焊",
    "node-diaphragm-arris": "节点隔板与壁板夹角过小，不设隔板",
    "node-diaphragms-meet": "节点隔板相碰",
    "node-manhole": "节点隔板人孔过小，人员不能通过",
    "piece-too-short": "板件短于规则允许长度，请移动拼接",
    "root-gap-lanes": "分条之间的根部间隙不从板上扣除",
    "root-gap-whole-seam": "根部间隙沿整条焊缝有效",
    "site-unit": "现场坐标按 mm 读取，请核对单位",
    "stagger-without-change": "错开量所在处厚度不变",
    "surface-border": "曲面边界在构件范围内",
    "surface-size": "曲面尺寸可疑，请核对单位",
    "thickness-joints-not-staggered": "变厚处各面拼接错开距离不足",
    "transition-short": "过渡段短于规则坡度所需长度",
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
    "point": "点",
    "top": "上",
    "bottom": "下",
    "left": "左",
    "right": "右",
}
_FACE_PAIR = re.compile(r"\bfaces (\w+) and (\w+)")


def finding_text(finding: Finding, style: SheetStyle) -> str:
    """A finding as one line in the style's language; codes without a Chinese sentence stay as they
    are."""
    if style.language != "zh" or finding.code not in FINDINGS_CHINESE:
        return finding.line(style.told_length).removeprefix(f"{finding.severity}: ")
    pair = _FACE_PAIR.search(finding.message)
    places = [finding.object, _translated(finding.position)]
    places += [_translated(" ".join(("faces", pair[1], "and", pair[2])))] if pair else []
    text = f"{'，'.join(place for place in places if place)}：{FINDINGS_CHINESE[finding.code]}"
    figures = [
        f"{name} {figure_text(float(value), finding.unit, style.told_length)}"
        for name, value in (("实际", finding.value), ("限值", finding.limit))
        if isinstance(value, (int, float))
    ]
    return text + (f"（{'，'.join(figures)}）" if figures else "")


def _translated(words: str) -> str:
    return re.sub(r"[A-Za-z]+", lambda word: _WORDS.get(word[0], word[0]), words)
