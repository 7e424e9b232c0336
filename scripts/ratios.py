#!/usr/bin/env python3
"""Compares the figures of two builds that were measured by turns: ratios.py OLDER.csv NEWER.csv COLUMN:LIMIT...

Prints the ratio newer / older of each figure, and its 95 % interval. Rows that agree in work, method, triangles and queries
form pairs in the order of the files, one pair per round. The ratio is the Hodges-Lehmann estimate: the median of the means of
any two pairs' logarithms. The interval is Wilcoxon's for signed ranks: it is exact for any noise that makes a ratio and its
inverse equally likely where nothing has changed. A figure of fewer than 6 pairs above 0 is not compared.
Exit status 1: an interval lies wholly above its limit. 2: nothing can be compared.
"""
import collections
import csv
import itertools
import math
import statistics
import sys

KEY = ('work', 'method', 'triangles', 'queries')
MIN_PAIRS = 6


def ratio_and_interval(ratios):
    """Returns the estimate and both ends of its interval; ratios: MIN_PAIRS of them or more, above 0."""
    count = len(ratios)
    means = sorted((a + b) / 2 for a, b in itertools.combinations_with_replacement(map(math.log, ratios), 2))
    ways = collections.Counter([0])  # of drawing ranks with this sum
    for rank in range(1, count + 1):
        ways += collections.Counter({total + rank: ways[total] for total in ways})
    sums = itertools.accumulate(ways[total] for total in range(len(means)))
    left_out = sum(1 for below in sums if below <= 0.025 * 2**count)
    return [math.exp(mean) for mean in (statistics.median(means), means[left_out - 1], means[-left_out])]


def rows_of(path):
    """Returns the rows of a file by their key, in order."""
    rows = collections.defaultdict(list)
    with open(path, newline='', encoding='utf-8') as file:
        for row in csv.DictReader(file):
            rows[tuple(row.get(column, '') for column in KEY)].append(row)
    return rows


def main(older_path, newer_path, *figures):
    older, newer = rows_of(older_path), rows_of(newer_path)
    worse = undecided = compared = 0
    print('| ' + ' | '.join(KEY) + ' | figure | older | newer | ratio | 95 % interval | limit | |\n' + '|---' * 11 + '|')
    for key in older:
        if key not in newer:
            continue
        for column, limit in (figure.split(':') for figure in figures):
            before, after = ([float(row[column]) for row in rows[key]] for rows in (older, newer))
            if len(before) != len(after):
                raise ValueError(f'{key}: {len(before)} rows of the older build, {len(after)} of the newer')
            ratios = [b / a for a, b in zip(before, after) if 0 < a < math.inf and 0 < b < math.inf]
            if len(ratios) < MIN_PAIRS:
                print(f'| {" | ".join(key)} | {column} | {len(ratios)} pairs are too few |' + ' |' * 5)
                continue
            ratio, low, high = ratio_and_interval(ratios)
            slower = low > float(limit)
            worse += slower
            undecided += low <= float(limit) < high
            compared += 1
            print(f'| {" | ".join(key)} | {column} | {statistics.median(before):.4g} | {statistics.median(after):.4g} '
                  f'| {ratio:.3f} | {low:.3f} to {high:.3f} | {limit} | {"WORSE" if slower else ""} |')
    for key in older.keys() ^ newer.keys():
        print(f'in the {"older" if key in older else "newer"} build only, not compared:', ', '.join(filter(None, key)))
    if compared == 0:
        raise ValueError('the builds have no row in common')
    print(f'{"FAIL" if worse else "pass"}: {worse} of {compared} ratios have a 95 % interval wholly above the limit')
    if undecided:
        print(f'{undecided} intervals reach above the limit: more rounds or a quieter machine would tell')
    return 1 if worse else 0


if __name__ == '__main__':
    try:
        sys.exit(main(*sys.argv[1:]))
    except (ValueError, TypeError, KeyError, OSError) as error:
        print(f'ratios.py: {error!r}', file=sys.stderr)
        sys.exit(2)
