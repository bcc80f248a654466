"""A histogram as a drawing in the page."""

from collections.abc import Sequence

HEIGHT = 70  # [px] of the tallest bar
WIDE = 30  # [px] of a tenth


def histogram(bins: Sequence[int], of: str) -> str:
    """SVG of how many reached each tenth of the points; its title says it in words."""
    most = max(*bins, 1)
    drawn: list[str] = []
    said: list[str] = []
    for i, count in enumerate(bins):
        high = round(HEIGHT * count / most)
        x, y = i * WIDE, HEIGHT + 14 - high
        if count:
            drawn.append(f'<rect x="{x + 2}" y="{y}" width="{WIDE - 4}" height="{high}"/>')
            middle = x + WIDE // 2
            drawn.append(f'<text x="{middle}" y="{y - 3}" text-anchor="middle">{count}</text>')
            said.append(f"{count} from {10 * i} to {10 * i + 10} %")
    width = WIDE * len(bins)
    for share in (0, 50, 100):
        x = width * share // 100
        anchor = {0: "start", 50: "middle", 100: "end"}[share]
        drawn.append(f'<text x="{x}" y="{HEIGHT + 30}" text-anchor="{anchor}">{share} %</text>')
    title = f"Histogram of {of}: {', '.join(said) or 'nobody has points yet'}"
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" class="histogram" role="img"'
        f' viewBox="0 0 {width} {HEIGHT + 34}"><title>{title}</title>'
        f'<line x1="0" x2="{width}" y1="{HEIGHT + 15}" y2="{HEIGHT + 15}"/>{"".join(drawn)}</svg>'
    )
