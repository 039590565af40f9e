"""Cuts the fonts down to the letters that the viewer takes from them: fonts.py FONTS_CPP FROM TO.

Which those are says the table `ranges` of sim/viewer/draw/fonts.cpp. Outlines and widths stay as they are."""
import re
import sys
from pathlib import Path

from fontTools import subset
from fontTools.ttLib import TTFont

SIGNS = "DejaVuSans.ttf"  # after the others: of it only what the first lacks
FACES = ("Inter-Regular.otf", "Inter-SemiBold.otf", "STIXGeneral-Italic.otf", "DejaVuSansMono.ttf", SIGNS)


def main():
    source, read_from, write_to = (Path(word) for word in sys.argv[1:])
    table = re.search(r"ranges\[\] = \{(.*?)\};", source.read_text(), re.S).group(1)
    ends = [int(word, 16) for word in re.findall(r"0x[0-9a-f]+", table)]
    letters = [code for first, last in zip(ends[::2], ends[1::2]) for code in range(first, last + 1)]
    write_to.mkdir(parents=True, exist_ok=True)
    faces = [next(read_from.rglob(name)) for name in FACES]
    has = set(TTFont(faces[0]).getBestCmap())
    for face in faces:
        if face.name == SIGNS:
            letters = [code for code in letters if code not in has]
        options = subset.Options(layout_features=[], hinting=False, notdef_outline=True, glyph_names=False)
        font = subset.load_font(str(face), options)
        cutter = subset.Subsetter(options)
        cutter.populate(unicodes=letters)
        cutter.subset(font)
        subset.save_font(font, str(write_to / face.name), options)


main()
