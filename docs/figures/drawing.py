"""Little helpers to draw figures as SVG: a canvas, axes with ticks, curves, text."""
from xml.sax.saxutils import escape

FONT = "'Helvetica Neue', Helvetica, Arial, 'DejaVu Sans', sans-serif"
INK, SOFT, FAINT, GRID = "#1f2933", "#52606d", "#9aa5b1", "#e4e7eb"
# Okabe and Ito's palette: told apart with any kind of colour vision, and in grey by their lightness.
BLUE, VERMILION, GREEN, GOLD = "#0072b2", "#d55e00", "#00795a", "#e69f00"


class Drawing:
    """An SVG picture, drawn in the order of the calls; lengths in pixels from the upper left corner."""

    def __init__(self, width, height, title):
        self.width, self.height, self.parts, self.clips = width, height, [], 0
        self.parts.append(f"<title>{escape(title)}</title>")
        # A white card with a hairline: the figure reads on a light page and on a dark one.
        self.parts.append(f'<rect x="0.5" y="0.5" width="{width - 1}" height="{height - 1}" rx="10" fill="#ffffff" '
                          f'stroke="{GRID}"/>')

    def line(self, x1, y1, x2, y2, color=INK, width=1.0, dash=None):
        dashed = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(f'<line x1="{x1:.2f}" y1="{y1:.2f}" x2="{x2:.2f}" y2="{y2:.2f}" stroke="{color}" '
                          f'stroke-width="{width}" stroke-linecap="round"{dashed}/>')

    def path(self, points, color=INK, width=1.5, dash=None, fill="none", closed=False, clip=None, opacity=1.0):
        data = "M" + "L".join(f"{x:.2f} {y:.2f}" for x, y in points) + ("Z" if closed else "")
        extra = (f' stroke-dasharray="{dash}"' if dash else "") + (f' clip-path="url(#{clip})"' if clip else "")
        extra += f' opacity="{opacity}"' if opacity < 1 else ""
        self.parts.append(f'<path d="{data}" fill="{fill}" stroke="{color}" stroke-width="{width}" '
                          f'stroke-linejoin="round" stroke-linecap="{"butt" if dash else "round"}"{extra}/>')

    def dot(self, x, y, radius=3.0, fill=INK, stroke="#ffffff"):
        self.parts.append(f'<circle cx="{x:.2f}" cy="{y:.2f}" r="{radius}" fill="{fill}" stroke="{stroke}" '
                          f'stroke-width="1.2"/>')

    def text(self, x, y, words, size=12, color=INK, anchor="start", weight=400, halo=False, turn=0):
        around = ' stroke="#ffffff" stroke-width="4" stroke-linejoin="round" paint-order="stroke"' if halo else ""
        turned = f' transform="rotate({turn} {x:.2f} {y:.2f})"' if turn else ""
        self.parts.append(f'<text x="{x:.2f}" y="{y:.2f}" font-size="{size}" fill="{color}" text-anchor="{anchor}" '
                          f'font-weight="{weight}"{around}{turned}>{escape(words)}</text>')

    def rectangle(self, x, y, width, height, fill="none", stroke="none", stroke_width=1.0):
        self.parts.append(f'<rect x="{x:.2f}" y="{y:.2f}" width="{width:.2f}" height="{height:.2f}" fill="{fill}" '
                          f'stroke="{stroke}" stroke-width="{stroke_width}"/>')

    def clip(self, x, y, width, height):
        self.clips += 1
        name = f"clip{self.clips}"
        self.parts.append(f'<clipPath id="{name}"><rect x="{x}" y="{y}" width="{width}" height="{height}"/></clipPath>')
        return name

    def arrow(self, x1, y1, x2, y2, color=INK, width=1.2, both=False):
        self.line(x1, y1, x2, y2, color, width)
        size = ((x2 - x1) ** 2 + (y2 - y1) ** 2) ** 0.5
        ux, uy = (x2 - x1) / size, (y2 - y1) / size
        for x, y, sign in ((x2, y2, 1), (x1, y1, -1))[:2 if both else 1]:
            back, half = 6.5 * sign, 2.6
            self.parts.append(f'<path d="M{x:.2f} {y:.2f}L{x - back * ux - half * uy:.2f} '
                              f'{y - back * uy + half * ux:.2f}L{x - back * ux + half * uy:.2f} '
                              f'{y - back * uy - half * ux:.2f}Z" fill="{color}"/>')

    def write(self, path):
        head = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{self.width}" height="{self.height}" '
                f'viewBox="0 0 {self.width} {self.height}" font-family="{FONT}" role="img">\n')
        path.write_text(head + "\n".join(self.parts) + "\n</svg>\n", encoding="utf-8")


class Axes:
    """A plot area on a drawing: maps data to the page, draws grid, ticks and axis titles."""

    def __init__(self, drawing, box, x_range, y_range):
        self.drawing, self.x_range, self.y_range = drawing, x_range, y_range
        self.left, self.top, self.width, self.height = box
        self.clip = drawing.clip(*box)

    def x(self, value):
        return self.left + (value - self.x_range[0]) / (self.x_range[1] - self.x_range[0]) * self.width

    def y(self, value):
        return self.top + (1 - (value - self.y_range[0]) / (self.y_range[1] - self.y_range[0])) * self.height

    def frame(self, x_ticks, y_ticks, x_title, y_title, x_format="{:g}", y_format="{:g}", size=12):
        d, bottom = self.drawing, self.top + self.height
        for value in y_ticks:
            d.line(self.left, self.y(value), self.left + self.width, self.y(value), GRID)
            d.text(self.left - 8, self.y(value) + 4, y_format.format(value), size, SOFT, "end")
        for value in x_ticks:
            d.line(self.x(value), bottom, self.x(value), bottom + 4, FAINT)
            d.text(self.x(value), bottom + 18, x_format.format(value), size, SOFT, "middle")
        d.line(self.left, bottom, self.left + self.width, bottom, FAINT)
        d.text(self.left + self.width / 2, bottom + 36, x_title, size, SOFT, "middle")
        d.text(self.left - 8, self.top - 12, y_title, size, SOFT, "start")

    def curve(self, xs, ys, color, width=2.0, dash=None, opacity=1.0):
        low, high = self.x_range
        points = [(self.x(x), self.y(y)) for x, y in zip(xs, ys) if low - 0.02 <= x <= high + 0.02]
        self.drawing.path(points, color, width, dash, clip=self.clip, opacity=opacity)
