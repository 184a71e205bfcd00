# SPDX-License-Identifier: Apache-2.0
"""The page: its HTML, and the look of its plots."""

import base64
import html
import io

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from PIL import Image

NOT_REPRODUCED = " (<span class='no'>not reproduced</span>)"
WIDTH = 9.2  # inches of a picture as wide as the page
INK, GREY = "#222222", "#9a9a9a"
COLOURS = ["#1f4e79", "#b5482a", "#4a7c3a", "#8a5fa8", "#b58a1c", "#3f8f8f", "#7a7a7a", "#c05a8a"]
STYLE = """
body{font:16px/1.55 Georgia,serif;color:#222;max-width:60rem;margin:2.5rem auto;padding:0 1.2rem}
h1,h2,h3,th,nav{font-family:system-ui,sans-serif}h1{font-size:1.7rem;margin-bottom:.2rem}
h2{font-size:1.3rem;margin-top:3rem;border-bottom:1px solid #ccc;padding-bottom:.2rem}
nav ol{columns:18rem 2;column-gap:2rem;font-size:.9rem;padding-left:0;list-style:none}
a{color:#1f4e79;text-decoration:none}
figure{margin:1.8rem 0}figure>img{max-width:100%;display:block}
figcaption{font-size:.9rem;color:#333;margin-top:.5rem}sub{line-height:0}
figcaption b{font-family:system-ui,sans-serif}
.scroll{overflow-x:auto}table{border-collapse:collapse;font-size:.85rem;margin:.6rem 0}
th{text-align:right;font-weight:600;border-bottom:1px solid #888;padding:.25rem .55rem}
td{text-align:right;padding:.2rem .55rem;border-bottom:1px solid #eee;white-space:nowrap;
font-variant-numeric:tabular-nums}th:first-child,td:first-child{text-align:left}
code{font-size:.85em;background:#f4f4f2;padding:.05rem .25rem}.no{color:#b5482a}.lead{color:#444}
.plates{display:grid;grid-template-columns:repeat(auto-fill,minmax(17rem,1fr));gap:.9rem;
font-size:.8rem}.plates.wide{grid-template-columns:
repeat(auto-fill,minmax(22rem,1fr))}.plates img{width:100%;display:block;margin-bottom:.2rem}
"""
plt.rcParams.update({
    "font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "axes.linewidth": 0.7,
    "axes.prop_cycle": plt.cycler(color=COLOURS), "lines.linewidth": 1.4, "axes.grid": True,
    "grid.color": "#e6e6e6", "grid.linewidth": 0.6, "legend.frameon": False, "legend.fontsize": 8,
    "axes.titlesize": 9.5, "svg.fonttype": "path", "svg.hashsalt": "thesis",
})


class Page:
    """folder: of the CSV files, and of the page. ground: what they were measured on, in words."""

    def __init__(self, folder, ground):
        self.folder, self.ground = folder, ground
        self.body, self.contents = [], []

    def chapter(self, number, title, lead):
        heading = f"Chapter {number}: {title}"
        self.body.append(f'<h2 id="c{number}">{heading}</h2><p class="lead">{lead}</p>')
        self.contents.append((f"c{number}", f"<b>{heading}</b>"))

    def show(self, inside, name, title, words):
        """inside: HTML. words: what the thesis says, what is found here, and the command."""
        anchor = "f" + "".join(c for c in name if c.isalnum())
        self.contents.append((anchor, f"{name}: {title}"))
        thesis, ours, command = words
        self.body.append(
            f'<figure id="{anchor}">{inside}<figcaption><b>{name}: {title}.</b> '
            f"<b>Thesis:</b> {thesis} <b>Here:</b> {ours} <code>{html.escape(command)}</code>"
            "</figcaption></figure>")

    def figure(self, name, title, picture, *words):
        data, width = io.BytesIO(), picture.get_figwidth() / WIDTH
        picture.savefig(data, format="svg", bbox_inches="tight", metadata={"Date": None})
        plt.close(picture)
        image = base64.b64encode(data.getvalue()).decode()
        self.show(f'<img alt="{html.escape(name)}" style="width:{width:.0%}" '
                  f'src="data:image/svg+xml;base64,{image}">', name, title, words)

    def table(self, name, title, head, rows, *words):
        heads = "".join(f"<th>{c}</th>" for c in head)
        cells = "".join("<tr>" + "".join(f"<td>{c}</td>" for c in row) + "</tr>" for row in rows)
        self.show(f'<div class="scroll"><table><tr>{heads}</tr>{cells}</table></div>', name, title,
                  words)

    def plates(self, name, title, files, *words):
        """files: (path of a picture, caption in HTML). They are kept as JPEG."""
        shown = []
        for path, caption in files:
            data = io.BytesIO()
            Image.open(path).convert("RGB").save(data, "JPEG", quality=88)
            image = base64.b64encode(data.getvalue()).decode()
            shown.append(f'<div><img alt="" src="data:image/jpeg;base64,{image}">{caption}</div>')
        wide = " wide" if len(files) in (2, 4) else ""
        self.show(f'<div class="plates{wide}">{"".join(shown)}</div>', name, title, words)

    def write(self):
        links = "".join(f'<li><a href="#{a}">{t}</a></li>' for a, t in self.contents)
        files = ", ".join(f'<a href="{p.name}">{p.name}</a>' for p in
                          sorted(self.folder.glob("*.csv")))
        (self.folder / "index.html").write_text(
            '<!doctype html><html lang="en"><meta charset="utf-8">'
            '<meta name="viewport" content="width=device-width">'
            f"<title>The thesis, made anew</title><style>{STYLE}</style>"
            "<h1>The thesis, made anew</h1>"
            "<p class='lead'>Tables and figures of L. Balmelli, <i>Rate-distortion optimal mesh "
            "simplification for communications</i> (EPFL 2000), chapters 2 to 7, measured with "
            f"this code on {html.escape(self.ground)}. The thesis's own terrain, of the Valais, is "
            "not to be had: numbers of decibels may differ, laws may not. docs/THESIS.md says "
            "where each section is implemented, and lists the errata.</p>"
            f"<nav><ol>{links}</ol></nav>{''.join(self.body)}"
            f"<h2>Data</h2><p>Drawn from {files}; the benches' own tables are in "
            "<a href='log.txt'>log.txt</a>.</p></html>")


def panels(columns=2, height=3.1, rows=1):
    return plt.subplots(rows, columns, figsize=(WIDTH, height * rows), layout="constrained")
