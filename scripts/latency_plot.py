#!/usr/bin/env python3
"""Plots the distributions that `latency --histogram` wrote: latency_plot.py HISTOGRAMS.tsv PNG

One panel for each method and size. Exit status 2: the file cannot be read or the picture cannot be written.
"""
import csv
import sys

# Colors of Okabe and Ito, which color-blind people can tell apart.
COLORS = {'pose to contacts': '#0072B2', 'pose to prediction': '#E69F00', 'pose to warning': '#D55E00'}
HALF_CLASS = 10 ** (0.5 / 20)  # twenty classes per decade


def panels_of(path):
    """Returns the classes [ms, share] of each quantity, by number of triangles and method, in the order of the file."""
    panels = {}
    with open(path, newline='', encoding='utf-8') as file:
        for line in csv.reader(file, delimiter='\t'):
            if len(line) != 5:
                raise ValueError(f'{path}: a line is not a class')
            method, triangles, work, middle, share = line
            if work in COLORS:
                panels.setdefault((int(triangles), method), {}).setdefault(work, []).append((float(middle), float(share)))
    return panels


def draw(panels, path):
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D
    sizes, methods = (list(dict.fromkeys(key[i] for key in panels)) for i in (0, 1))
    height = 0.7 + 2.9 * len(sizes)
    figure = Figure(figsize=(1 + 6 * len(methods), height))
    figure.set_layout_engine('constrained', rect=(0, 0, 1, 1 - 0.4 / height))  # the key is above
    grid = figure.subplots(len(sizes), len(methods), sharex=True, squeeze=False)
    for (size, method), distributions in panels.items():
        axes = grid[sizes.index(size)][methods.index(method)]
        for work, classes in distributions.items():
            edges = [middle / HALF_CLASS for middle, _ in classes] + [classes[-1][0] * HALF_CLASS]
            axes.stairs([100 * share for _, share in classes], edges, color=COLORS[work], linewidth=2)
        axes.set(xscale='log', xlim=(0.03, 1000), ylabel='%', title=f'{size} triangles, {method}')
        axes.set_ylim(bottom=0)
        axes.xaxis.set_major_formatter('{x:g}')
        axes.grid(color='#d0d0d0')
        axes.set_axisbelow(True)
    for axes in grid[-1]:
        axes.set_xlabel('[ms]')
    key = [Line2D([], [], color=color, linewidth=4, label=work) for work, color in COLORS.items()]
    figure.legend(handles=key, loc='upper center', ncol=len(key), frameon=False)
    figure.savefig(path)


if __name__ == '__main__':
    try:
        if len(sys.argv) != 3:
            raise ValueError('usage: latency_plot.py HISTOGRAMS.tsv PNG')
        draw(panels_of(sys.argv[1]), sys.argv[2])
    except (ValueError, OSError, ImportError) as error:
        print(f'latency_plot.py: {error}', file=sys.stderr)
        sys.exit(2)
