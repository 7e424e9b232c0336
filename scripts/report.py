#!/usr/bin/env python3
"""Prints the results of `compare` as tables, checks them against the requirements, and plots them: report.py FILE.csv [--plots DIR]

Exit status 1: one of our detectors missed a triangle, or named one beyond its stated inflation. 2: the file or a plot failed.
"""
import csv
import itertools
import math
import os
import sys

OURS = 'halfspace'  # the detector that the others are compared with
DETECTORS = ('halfspace', 'reference', 'select')
SMALL, LARGE, HUGE = 1600, 99856, 1000000
# Least ratios to ours, p10: of one query at SMALL, of one at LARGE, of twenty at LARGE.
PEERS = {'FCL AABB': (15, 55, 15), 'Embree': (6, 24, 4.5), 'Bullet': (7, 33, 6), 'scalar': (2.4, 6.5, 22),
         'OSMesa': (120, 1000, 2000)}  # at SMALL ours is little more than fixed costs, which differ between machines
# Largest ratios of a frame with one sweep to a plain reading.
READ = {HUGE: 1.5, LARGE: 4.5}
# Colors of Okabe and Ito, which color-blind people can tell apart; their yellow is darkened.
COLORS = ('#000000', '#E69F00', '#56B4E9', '#009E73', '#B0A000', '#0072B2', '#D55E00', '#CC79A7')
MARKERS = 'os^vD<>pPX*hd8'


def rows_of(path):
    types = {'work': str, 'method': str, 'triangles': int, 'queries': int, 'misses': int, 'extras': int}
    with open(path, newline='', encoding='utf-8') as file:
        rows = [row for row in csv.DictReader(file) if row.get('work') != 'work']  # files may be joined
    for row in rows:
        if None in row or None in row.values() or 'extras' not in row:
            raise ValueError(f'{path}: not a line of benchmark results: {list(row.values())}')
        for column, text in row.items():
            row[column] = types.get(column, float)(text) if text != '' else None
        row['wrong'] = (row['misses'] or 0) + (row['extras'] or 0) > 0
    return rows


def series(rows, work, queries):
    """Returns the rows of each method by their number of triangles, in the order in which the methods were measured."""
    found = {}
    for row in rows:
        if row['work'] == work and row['queries'] == queries:
            found.setdefault(row['method'], {}).setdefault(row['triangles'], row)
    return found


def cell(row):
    if row is None:
        return '-'
    text = f'{row["median_us"]:.3g}'
    if row['ratio_median'] is not None:
        text += f' ({row["ratio_median"]:.2g}, {row["ratio_p10"]:.2g})'
    return text + (' misses' if row['misses'] else '')


def print_table(rows, work, queries):
    methods = series(rows, work, queries)
    if not methods:
        return
    sizes = sorted({row['triangles'] for row in rows if row['work'] == work})
    print(f'\n{work}, {queries} queries: median us (ratio to {OURS}: median, p10)')
    print('| method |', *(f'{size} |' for size in sizes))
    print('|---|' + '---|' * len(sizes))
    for method, results in methods.items():
        print(f'| {method} |', *(f'{cell(results.get(size))} |' for size in sizes))


def requirements(rows):
    """Yields the text, the value (None: not measured), the relation and the bound of each requirement."""
    def value(column, work, method, triangles, queries):
        return series(rows, work, queries).get(method, {}).get(triangles, {}).get(column)

    for method, bounds in PEERS.items():
        for (triangles, queries), bound in zip(((SMALL, 1), (LARGE, 1), (LARGE, 20)), bounds):
            ratio = value('ratio_p10', 'ordered', method, triangles, queries)
            yield f'{method} / ours, {triangles} triangles, queries {queries}, p10', ratio, '>=', bound
    update = value('ratio_median', 'update', 'memory read', HUGE, 0)
    yield f'memory read / update pass, {HUGE} triangles', update, '>=', 0.8
    for triangles, bound in READ.items():
        read = value('ratio_median', 'ordered', 'memory read', triangles, 1)
        yield f'frame / memory read, {triangles} triangles', read and 1 / read, '<=', bound
    small, huge = (value('median_us', 'ordered', OURS, triangles, 1) for triangles in (SMALL, HUGE))
    exponent = math.log(huge / small) / math.log(HUGE / SMALL) if small and huge else None
    yield f'exponent from {SMALL} to {HUGE} triangles', exponent, '<=', 0.9
    for queries, bound in (1, 3), (20, 5):
        select = value('ratio_median', 'ordered', 'select', LARGE, queries)
        yield f'select / {OURS}, {LARGE} triangles, queries {queries}', select, '<=', bound


def print_requirements(rows):
    print('\nRequirements, with AVX-512, on a quiet machine; medians unless marked p10:')
    for text, value, relation, bound in requirements(rows):
        if value is None:
            print(f'not measured  {text} {relation} {bound}')
        else:
            passes = value >= bound if relation == '>=' else value <= bound
            print(f'{"pass" if passes else "FAIL":12}  {text}: {value:.3g} {relation} {bound}')


def print_errors(rows):
    """Returns whether there were any."""
    wrong = [row for row in rows if row['wrong'] and row['method'].startswith(DETECTORS)]
    for row in wrong:
        print('WRONG: {method}: {work}, {triangles} triangles, {queries} queries: {misses} misses, {extras} extras'.format(**row))
    print('our detectors:', 'WRONG, see above' if wrong else 'no misses, no extras')
    return bool(wrong)


def styles(rows):
    """Returns the look of each method, the same in all pictures: dashed from the ninth on, dotted and gray the memory reads."""
    looks = {'memory read': {'color': '#808080', 'linestyle': ':', 'linewidth': 3},
             'memory read fetched ahead': {'color': '#b0b0b0', 'linestyle': ':', 'linewidth': 3}}
    methods = dict.fromkeys([OURS] + [row['method'] for row in rows if row['work'] == 'ordered'])
    lines = ((line, color) for line in ('-', '--') for color in COLORS)
    for method, (line, color), marker in zip((m for m in methods if m not in looks), lines, itertools.cycle(MARKERS)):
        looks[method] = {'color': color, 'linestyle': line, 'marker': marker, 'capsize': 2}
    return looks


def plot(rows, work, queries, folder):
    from matplotlib.figure import Figure  # the tables go without it
    figure = Figure(figsize=(11, 7.5), layout='constrained')
    axes = figure.add_subplot(xscale='log', yscale='log', xlabel='triangles', title=f'{work} mesh')
    axes.set_ylabel(f'update and {queries} {"query" if queries == 1 else "queries"} [µs], median, p10 to p90')
    axes.grid(color='#d0d0d0')
    looks = styles(rows)
    lines = series(rows, work, queries)
    # The key begins with the method that takes most time per triangle.
    for method, results in sorted(lines.items(), key=lambda line: -line[1][max(line[1])]['median_us'] / max(line[1])):
        found = [results[size] for size in sorted(results)]
        spread = [[row['median_us'] - row['p10_us'] for row in found], [row['p90_us'] - row['median_us'] for row in found]]
        axes.errorbar([row['triangles'] for row in found], [row['median_us'] for row in found],
                      None if method.startswith('memory read') else spread, label=method, **looks.get(method, {}))
    if lines:
        axes.legend(loc='upper left', bbox_to_anchor=(1, 1), frameon=False)
    figure.savefig(os.path.join(folder, f'time_{work.replace(" ", "_")}_{queries}.png'))


def main(arguments):
    if len(arguments) != 1 and not (len(arguments) == 3 and arguments[1] == '--plots'):
        raise ValueError('usage: report.py FILE.csv [--plots DIR]')
    rows = rows_of(arguments[0])
    print_table(rows, 'update', 0)
    for work in 'ordered', 'shuffled', 'no hit', 'one hit':
        for queries in 1, 20:
            print_table(rows, work, queries)
    print_requirements(rows)
    wrong = print_errors(rows)
    if len(arguments) == 3:
        for work in 'ordered', 'shuffled':
            for queries in 1, 20:
                plot(rows, work, queries, arguments[2])
    return 1 if wrong else 0


if __name__ == '__main__':
    try:
        sys.exit(main(sys.argv[1:]))
    except (ValueError, TypeError, KeyError, OSError, ImportError) as error:
        print(f'report.py: {error}', file=sys.stderr)
        sys.exit(2)
