#!/usr/bin/env python3
"""Prints the results of `compare` as tables, and checks them against the requirements: report.py FILE.csv. plot.py draws them.

Exit status 1: one of our detectors missed a triangle, or named one beyond its stated inflation. 2: the file cannot be read.
"""
import csv
import math
import sys

OURS = 'halfspace'  # the detector that the others are compared with
DETECTORS = ('halfspace', 'reference', 'select')
SMALL, LARGE, HUGE = 1600, 99856, 1000000
# Least ratios to ours, p10: of one query at SMALL, of one at LARGE, of twenty at LARGE.
PEERS = {'FCL AABB': (15, 55, 15), 'Embree': (6, 24, 4.5), 'Bullet': (7, 33, 6), 'scalar': (2.4, 6.5, 22),
         'OSMesa': (120, 1000, 2000)}  # at SMALL ours is little more than fixed costs, which differ between machines
# Largest ratios of a frame with one sweep to a plain reading.
READ = {HUGE: 1.5, LARGE: 4.5}


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


def main(arguments):
    if len(arguments) != 1:
        raise ValueError('usage: report.py FILE.csv')
    rows = rows_of(arguments[0])
    print_table(rows, 'update', 0)
    for work in 'ordered', 'shuffled', 'no hit', 'one hit':
        for queries in 1, 20:
            print_table(rows, work, queries)
    print_requirements(rows)
    return 1 if print_errors(rows) else 0


if __name__ == '__main__':
    try:
        sys.exit(main(sys.argv[1:]))
    except (ValueError, TypeError, KeyError, OSError) as error:
        print(f'report.py: {error}', file=sys.stderr)
        sys.exit(2)
