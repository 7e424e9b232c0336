#!/usr/bin/env python3
"""compare_answers.py FILE OTHER: compares what the program `answers` has written on two machines.

The sets of triangles must be the same, and times of impact to 1e-12 of the motion. Only one of the machines may have a
detector that needs OpenGL: says so. Exit status 1 if an answer differs, 2 if nothing was compared.
"""
import sys

TOLERANCE = 1e-12


def answers(name):
    """Returns the items of each answer by (case, detector, kind)."""
    found = {}
    with open(name) as lines:
        for line in lines:
            words = line.split()
            if len(words) >= 3 and '#' in words[0]:
                found[tuple(words[:3])] = dict((item.split(':') + ['0'])[:2] for item in words[3:])
    return found


def difference(one, other):
    """Returns None if both have the same triangles at the same times."""
    if one.keys() != other.keys():
        return 'triangles ' + ' '.join(sorted(one.keys() ^ other.keys()))
    largest = max((abs(float(time) - float(other[triangle])) for triangle, time in one.items()), default=0.0)
    return None if largest <= TOLERANCE else 'times differ by %g' % largest


def main():
    one, other = (answers(name) for name in sys.argv[1:3])
    both = sorted(one.keys() & other.keys())
    alone = sorted({key[1] for key in one.keys() ^ other.keys()} - {key[1] for key in both})
    unanswered = [key for key in one.keys() ^ other.keys() if key[1] not in alone]
    different = [(key, text) for key in both for text in [difference(one[key], other[key])] if text]
    for key, text in different[:20]:
        print(' '.join(key) + ': ' + text)
    for key in sorted(unanswered)[:20]:
        print(' '.join(key) + ': answered by one only')
    items = sum(len(one[key]) for key in both)
    print('%d answers with %d triangles, %d differ, %d by one only; detectors: %s%s' % (
        len(both), items, len(different), len(unanswered), ' '.join(sorted({key[1].split('/')[0] for key in both})),
        '; not compared: ' + ' '.join(alone) if alone else ''))
    return 1 if different or unanswered else 0 if items else 2


if __name__ == '__main__':
    sys.exit(main())
