"""Cuts the fonts down to the letters that the viewer takes from them: fonts.py FONTS_CPP FROM TO.

Which those are says the table `ranges` of sim/viewer/draw/fonts.cpp. Outlines and widths stay as they are."""
import re
import sys
from pathlib import Path

from fontTools import subset


def main():
    source, read_from, write_to = (Path(word) for word in sys.argv[1:])
    table = re.search(r"ranges\[\] = \{(.*?)\};", source.read_text(), re.S).group(1)
    ends = [int(word, 16) for word in re.findall(r"0x[0-9a-f]+", table)]
    letters = [code for first, last in zip(ends[::2], ends[1::2]) for code in range(first, last + 1)]
    write_to.mkdir(parents=True, exist_ok=True)
    for name in ("DejaVuSans.ttf", "DejaVuSans-Bold.ttf", "DejaVuSansMono.ttf"):
        options = subset.Options(layout_features=[], hinting=False, notdef_outline=True, glyph_names=False)
        font = subset.load_font(str(read_from / name), options)
        cutter = subset.Subsetter(options)
        cutter.populate(unicodes=letters)
        cutter.subset(font)
        subset.save_font(font, str(write_to / name), options)


main()
