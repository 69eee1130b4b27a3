"""Pictures of docs/lab/accuracy.md, with Debian's python3-matplotlib."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from measuring.tables import PAGE  # noqa: E402

folder = PAGE.parent.parent / "figures"

plt.rcParams.update({"font.size": 9, "axes.grid": True, "grid.alpha": 0.3, "lines.linewidth": 1.2,
                     "axes.spines.top": False, "axes.spines.right": False})


def save(figure, name):
    """Markdown of the picture."""
    folder.mkdir(parents=True, exist_ok=True)
    figure.tight_layout()
    figure.savefig(folder / name, dpi=110, bbox_inches="tight", metadata={"Software": None})
    plt.close(figure)
    return f"![{name.removesuffix('.png').replace('-', ' ')}](../figures/{name})"


def curves(name, panels, x_label, y_label, columns=2, y_top=None, log_x=False):
    """panels: {title: {label: [(x, y)]}}; one legend for all."""
    rows = (len(panels) + columns - 1) // columns
    figure, axes = plt.subplots(rows, min(columns, len(panels)), figsize=(4.6 * min(columns, len(panels)), 2.7 * rows + 0.3),
                                squeeze=False)
    for axis in axes.flat[len(panels):]:
        axis.set_visible(False)
    for axis, (title, lines) in zip(axes.flat, panels.items()):
        for label, points in lines.items():
            axis.plot(*zip(*points), label=label, marker="o" if len(points) < 15 else None, markersize=3)
        axis.set(title=title, xlabel=x_label, ylabel=y_label)
        axis.set_ylim(0, y_top)
        if log_x:
            axis.set_xscale("log")
    handles, labels = axes.flat[0].get_legend_handles_labels()
    if len(labels) > 1:
        figure.legend(handles, labels, loc="lower center", ncol=min(len(labels), 4), frameon=False, bbox_to_anchor=(0.5, -0.07 / rows))
    return save(figure, name)


def bars(name, groups, y_label, lines=()):
    """groups: {label of a series: {name of a bar: value}}; lines: horizontal limits."""
    figure, axis = plt.subplots(figsize=(9.2, 3.2))
    names = list(next(iter(groups.values())))
    width = 0.8 / len(groups)
    for i, (label, values) in enumerate(groups.items()):
        axis.bar([k + (i - (len(groups) - 1) / 2) * width for k in range(len(names))],
                 [values[n] for n in names], width, label=label)
    for value in lines:
        axis.axhline(value, color="black", linewidth=0.8, linestyle="--")
    axis.set_xticks(range(len(names)), names, rotation=60, ha="right")
    axis.set_ylabel(y_label)
    axis.legend(frameon=False)
    return save(figure, name)
