# SPDX-License-Identifier: Apache-2.0
# web_arrival_images.py IN QUALITY OUT [HALVINGS]: a picture as JPEG or WebP (OUT's ending says which),
# as small as these codecs make it, of half the size so many times. OUT that is a folder: a pyramid of
# JPEG tiles, OUT/LEVEL_X_Y.jpg.
import os
import sys

from PIL import Image

SIDE = 256


FINE = 90  # from this quality on JPEG's colours are as fine as its brightness


def save(picture, path, quality, **more):
    if path.endswith(".webp"):
        more = {"method": 6}
    else:
        more = {"optimize": True, "subsampling": 0 if quality >= FINE else 2, **more}
    picture.save(path, quality=quality, **more)


def halved(picture):
    width, height = picture.size
    return picture.resize(((width + 1) // 2, (height + 1) // 2), Image.Resampling.BOX)


def save_pyramid(picture, folder, quality):
    level = 0
    while True:
        width, height = picture.size
        for y in range(0, height, SIDE):
            for x in range(0, width, SIDE):
                tile = picture.crop((x, y, min(x + SIDE, width), min(y + SIDE, height)))
                save(tile, f"{folder}/{level}_{x // SIDE}_{y // SIDE}.jpg", quality)
        if max(width, height) <= SIDE:
            return
        picture = halved(picture)
        level += 1


path, quality, out = sys.argv[1], int(sys.argv[2]), sys.argv[3]
source = Image.open(path).convert("RGB")
if os.path.isdir(out):
    save_pyramid(source, out, quality)
else:
    for _ in range(int(sys.argv[4])):
        source = halved(source)
    save(source, out, quality, progressive=True)
