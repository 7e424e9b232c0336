#!/usr/bin/env python3
"""Plots the shares that `latency --stages` wrote: stages_plot.py STAGES.csv PNG

One bar for each method and size. Exit status 2: the file cannot be read or the picture cannot be written.
"""
import csv
import sys

# Colors of Okabe and Ito, which color-blind people can tell apart.
COLORS = ['#56B4E9', '#0072B2', '#CC79A7', '#E69F00', '#D55E00', '#F0E442', '#009E73']


def bars_of(path):
    """Returns the percents of each stage, by number of triangles and method, in the order of the file."""
    bars = {}
    with open(path, newline='', encoding='utf-8') as file:
        for row in csv.DictReader(file):
            bar = bars.setdefault((int(row['triangles']), row['method']), {})
            bar[row['stage']] = float(row['percent_of_a_processor'])
    if not bars:
        raise ValueError(f'{path}: no stages')
    return bars


def draw(bars, path):
    from matplotlib.figure import Figure
    stages = list(next(iter(bars.values())))
    height = 1.4 + 0.45 * len(bars)
    figure = Figure(figsize=(9, height))
    figure.set_layout_engine('constrained', rect=(0, 0, 1, 1 - 0.4 / height))  # the key is above
    axes = figure.subplots()
    names = [f'{triangles} triangles, {method}' for triangles, method in bars]
    left = [0.0] * len(bars)
    for stage, color in zip(stages, COLORS):
        shares = [bar[stage] for bar in bars.values()]
        axes.barh(names, shares, left=left, color=color, label=stage)
        left = [a + b for a, b in zip(left, shares)]
    axes.invert_yaxis()
    axes.set_xlabel("[%] of one processor's time")
    axes.grid(axis='x', color='#d0d0d0')
    axes.set_axisbelow(True)
    figure.legend(loc='upper center', ncol=len(stages), frameon=False, fontsize='small')
    figure.savefig(path)


if __name__ == '__main__':
    try:
        if len(sys.argv) != 3:
            raise ValueError('usage: stages_plot.py STAGES.csv PNG')
        draw(bars_of(sys.argv[1]), sys.argv[2])
    except (KeyError, ValueError, OSError, ImportError) as error:
        print(f'stages_plot.py: {error}', file=sys.stderr)
        sys.exit(2)
