# SPDX-License-Identifier: Apache-2.0
"""bench/thesis runs this: thesis_page FOLDER GROUND. Draws FOLDER/index.html from the CSV files
that the benches left there, chapter by chapter. GROUND: what they were run on, in words."""

import sys
from pathlib import Path

import chapter_2
import chapter_3
import chapter_4
import chapter_5
import chapter_6
import chapter_7
from page import Page


def main():
    page = Page(Path(sys.argv[1]), sys.argv[2])
    for chapter in (chapter_2, chapter_3, chapter_4, chapter_5, chapter_6, chapter_7):
        chapter.write(page)
    page.write()


main()
