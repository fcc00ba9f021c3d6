# SPDX-License-Identifier: LGPL-2.1-or-later
"""Headings of schedule sheets: where their row is, and their names in Chinese."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Sequence

MOST_CELLS = 2_000_000
"""Cells of the rectangle a sheet may span."""
MOST_COLUMNS = 16_384
"""Columns of a sheet in spreadsheet programs."""
TITLE_ROWS = 12
"""Rows a table's headings are looked for in: titles, dates and logos may stand above."""

SHEET_ALIASES = {
    "设置": "Settings",
    "材料": "Materials",
    "曲面": "Surfaces",
    "点": "Points",
    "控制点": "Points",
    "轴线": "Axes",
    "标架": "Frames",
    "预变形": "Presets",
    "预拱": "Presets",
    "截面": "Sections",
    "板条": "Strips",
    "构件": "Members",
    "节点": "Nodes",
    "单元": "Pieces",
    "运输单元": "Pieces",
    "坡口": "Preps",
    "板边": "Edges",
    "焊缝": "Edges",
    "分段": "Splits",
    "拼接": "Splits",
    "隔板": "Diaphragms",
    "横隔板": "Diaphragms",
    "开孔": "Openings",
    "标记": "Marks",
    "状态": "Status",
}

_BY_LOWER = {sheet.lower(): sheet for sheet in SHEET_ALIASES.values()}

# One list for all sheets: where an alias stands for several columns the sheet decides.
COLUMN_ALIASES = {
    "键": ("key",),
    "项目": ("key",),
    "值": ("value",),
    "材料": ("material",),
    "材质": ("material",),
    "密度": ("density",),
    "弹性模量": ("E",),
    "屈服强度": ("fy",),
    "曲面": ("surface",),
    "类型": ("type", "kind"),
    "文件": ("file",),
    "参数": ("parameters",),
    "偏移": ("offset",),
    "反向": ("flip",),
    "轴线": ("axis",),
    "轴": ("axis",),
    "序号": ("no", "segment"),
    "编号": ("no",),
    "标架": ("frame",),
    "拟合": ("fit",),
    "来源": ("source",),
    "最大间距": ("max_spacing",),
    "闭合": ("closed",),
    "起点标高": ("start_z",),
    "终点标高": ("end_z",),
    "起点抬高": ("start_dz",),
    "终点抬高": ("end_dz",),
    "起点延长": ("start_extension",),
    "终点延长": ("end_extension",),
    "位置": ("s",),
    "角度": ("angle",),
    "截面": ("section",),
    "高": ("h",),
    "高度": ("h",),
    "宽": ("b",),
    "宽度": ("b",),
    "厚": ("t",),
    "厚度": ("t",),
    "板厚": ("t",),
    "顶板厚": ("t_top",),
    "上翼缘厚": ("t_top",),
    "底板厚": ("t_bottom",),
    "下翼缘厚": ("t_bottom",),
    "腹板厚": ("t_web",),
    "间隙1": ("gap1",),
    "间隙2": ("gap2",),
    "构件": ("member",),
    "构件号": ("member",),
    "段": ("segment",),
    "分段": ("segment",),
    "切点": ("cut",),
    "变截面起点": ("cut",),
    "坡度": ("slope",),
    "对齐": ("align",),
    "对齐基准": ("align_to",),
    "偏移y": ("offset_y",),
    "偏移z": ("offset_z",),
    "整体偏移y": ("member_offset_y",),
    "整体偏移z": ("member_offset_z",),
    "扭转": ("roll",),
    "转角": ("roll",),
    "优先级": ("rank",),
    "面": ("face",),
    "板面": ("face",),
    "零件号": ("plate",),
    "板件号": ("plate",),
    "状态": ("status",),
    "间隙": ("gap",),
    "切角": ("snipe",),
    "人孔": ("manhole",),
    "封板面": ("closing_face",),
    "孔形": ("shape",),
    "旋转": ("rotation",),
    "文字": ("text",),
    "拼缝": ("joints",),
    "接缝": ("joints",),
    "分条": ("lanes",),
    "型材": ("catalogue",),
    "型钢": ("catalogue",),
    "底宽": ("b_bottom",),
    "角部": ("corner_joint",),
    "角部连接": ("corner_joint",),
    "角点": ("corners",),
    "各板厚": ("thicknesses",),
    "代号": ("letter",),
    "起点y": ("y1",),
    "起点z": ("z1",),
    "终点y": ("y2",),
    "终点z": ("z2",),
    "侧": ("side",),
    "起端止于": ("stop1",),
    "终端止于": ("stop2",),
    "过渡": ("transition",),
    "错开": ("stagger",),
    "起端切割": ("start_cut",),
    "终端切割": ("end_cut",),
    "展开方式": ("mode",),
    "展开面": ("flattened_surface",),
    "划线面": ("marking_face",),
    "纵向收缩": ("shrinkage_along",),
    "横向收缩": ("shrinkage_across",),
    "对接余量": ("joint_allowance",),
    "隔板余量": ("diaphragm_allowance",),
    "起端余量": ("green_start",),
    "终端余量": ("green_end",),
    "接长": ("splice",),
    "轮廓": ("contour",),
    "节点": ("node",),
    "贯通构件": ("through",),
    "支构件": ("other",),
    "牛腿长": ("stub_length",),
    "牛腿长度": ("stub_length",),
    "隔板": ("diaphragms",),
    "圆顺": ("blend",),
    "单元": ("piece",),
    "起点": ("from",),
    "终点": ("to",),
    "起端形式": ("start_end",),
    "终端形式": ("end_end",),
    "坡口": ("prep",),
    "坡口号": ("prep",),
    "钝边": ("land",),
    "衬垫": ("backing",),
    "焊脚": ("leg",),
    "焊缝": ("seam",),
    "施焊地点": ("place",),
    "无损检测": ("ndt",),
    "探伤": ("ndt",),
}


def sheet_name(title: str) -> str:
    """The sheet a title stands for, whatever its case; the title itself when it has no other
    name."""
    plain = _plain(title)
    return SHEET_ALIASES.get(plain) or _BY_LOWER.get(plain, title)


def heading_name(value, columns: Iterable[str]) -> str:
    """The column a heading stands for on a sheet of these columns, whatever its case; the heading
    itself otherwise. What follows in brackets, such as a unit, is left out of a Chinese heading."""
    written = str(value).strip()
    known = tuple(columns)
    if written in known:
        return written
    plain = _plain(written)
    alike = [name for name in known if name.lower() == plain]
    if alike:
        return alike[0]
    alias = _plain(written.split("(")[0].split("（")[0])
    return next((name for name in COLUMN_ALIASES.get(alias, ()) if name in known), written)


def heading_row(rows: Sequence[Sequence], columns: Iterable[str]) -> int:
    """Number, from 1, of the row that holds the headings: the first of which at least half the
    cells, and two of them (or the only one), name columns; 1 when there is none."""
    known = tuple(columns)
    for number, row in enumerate(rows[:TITLE_ROWS], start=1):
        cells = [cell for cell in row if cell is not None and str(cell).strip()]
        named = sum(heading_name(cell, known) in known for cell in cells)
        if named and 2 * named >= len(cells) and (named > 1 or len(known) == 1):
            return number
    return 1


def _plain(word: str) -> str:
    return unicodedata.normalize("NFKC", str(word)).strip().lower()
