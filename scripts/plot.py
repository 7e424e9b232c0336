#!/usr/bin/env python3
"""Draws, with matplotlib, what programs of sweep_guard have written as CSV files.

    plot.py FILE PICTURE    what evaluate_prediction wrote for --csv, --tradeoff-csv, --calibration-csv, --sessions-csv or
                            --tune-csv, latency for --histogram or --stages, or compare for --csv
    plot.py FOLDER NAME     the report of replay_report: timeline.png, contacts.png and touches.png in that folder, with the
                            name of the session

Exit status 2: matplotlib is missing, a file cannot be read, or a picture cannot be written.
"""
import csv
import itertools
import math
import os
import sys

# Colors of Okabe and Ito, which color-blind people can tell apart.
COLORS = ['#0072B2', '#56B4E9', '#009E73', '#999999', '#D55E00', '#E69F00', '#CC79A7', '#F0E442']
PREDICTORS = {'direct': '#0072B2', 'polynomial': '#D55E00', 'constant_velocity': '#009E73', 'hold': '#777777'}
SCALES = {'one plane': '#999999', 'the guard': '#0072B2', 'fitted to the other recordings': '#D55E00'}
LATENCIES = {'pose to contacts': '#0072B2', 'pose to prediction': '#E69F00', 'pose to warning': '#D55E00'}
METHODS = ['#000000'] + COLORS
READS = {'memory read': {'color': '#808080', 'linestyle': ':', 'linewidth': 3},
         'memory read fetched ahead': {'color': '#b0b0b0', 'linestyle': ':', 'linewidth': 3}}
HALF_CLASS = 10 ** (0.5 / 20)  # of a distribution with twenty classes per decade
# Those of warning_level.h; a test compares them.
LEVELS = {'UNKNOWN': '#8c8c8c', 'CLEAR': '#2eb05c', 'CONSIDERED': '#ffb000', 'REFLEX': '#de1a1a', 'CONTACT': '#de1a1a'}
UNTOUCHED = -0.15  # on the scale of colors, where the touched triangles are from 0 to 1
TOUCH_COLORS = ['#d6cdbc', '#d6cdbc', '#dadaeb', '#bcbddc', '#9e9ac8', '#807dba', '#6a51a3', '#4a1486']
MAX_CONTACTS = 40
MAX_WORKPIECES = 4
KEY = 0.45  # height [inch] above the panels


def rows_of(path, **options):
    with open(path, newline='', encoding='utf-8', errors='replace') as file:
        rows = list(csv.DictReader(file, **options))
    if any(None in row.values() for row in rows):
        raise ValueError(f'{path}: a line has fewer columns than the first')
    return rows


def column(rows, name):
    return [float(row[name] or 'nan') for row in rows]


def by(rows, *names):
    """Returns the rows by the values of some columns, in the order of the file."""
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row[name] for name in names) if len(names) > 1 else row[names[0]], []).append(row)
    return groups


def plain(text):
    return text.replace('$', r'\$')


def page(rows, columns, row_height=2.9, width=13.0, **options):
    """Returns a figure, and its panels by row and column."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    figure = Figure(figsize=(width, KEY + row_height * rows))
    FigureCanvasAgg(figure)
    grid = figure.subplots(rows, columns, squeeze=False, **options)
    for axes in grid.flat:
        axes.grid(color='#d0d0d0')
        axes.set_axisbelow(True)
    return figure, grid


def write_numbers(axis):
    from matplotlib.ticker import StrMethodFormatter
    axis.set_major_formatter(StrMethodFormatter('{x:g}'))


def save(figure, picture, key, **options):
    """Puts the key, of labels and styles, above the panels, and writes the picture."""
    from matplotlib.lines import Line2D
    if key:
        lines = [Line2D([], [], label=plain(label), **style) for label, style in key]
        figure.legend(handles=lines, loc='upper center', ncol=len(lines), frameon=False, **options)
    figure.tight_layout(rect=(0, 0, 1, 1 - KEY / figure.get_figheight()))
    figure.savefig(picture)


def colored(names, colors, width=4):
    return [(name, {'color': colors.get(name, '#CC79A7'), 'linewidth': width}) for name in names]


def draw_errors(rows, picture):
    recordings = by(rows, 'recording')
    figure, grid = page(len(recordings), 2)
    horizons = column(rows, 'horizon_s')
    quantities = [('position', 'mm', 'm', 1e3), ('rotation', 'deg', 'rad', 180 / math.pi)]
    for line, (recording, of_recording) in zip(grid, recordings.items()):
        for axes, (name, unit, unit_in_file, scale) in zip(line, quantities):
            for predictor, some in by(of_recording, 'predictor').items():
                for percentile, style in (('p95', '--'), ('median', '-')):
                    errors = [scale * error for error in column(some, f'{name}_{percentile}_{unit_in_file}')]
                    axes.plot(column(some, 'horizon_s'), errors, style, color=PREDICTORS.get(predictor, '#CC79A7'))
            axes.set(xscale='log', yscale='log', title=plain(recording), ylabel=f'{name} error [{unit}]')
            axes.set_xticks([tick for tick in (0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10) if min(horizons) <= tick <= max(horizons)])
            axes.set_xticks([], minor=True)
            write_numbers(axes.xaxis)
            write_numbers(axes.yaxis)
    for axes in grid[-1]:
        axes.set_xlabel('horizon [s]')
    styles = [('median', {'color': 'black'}), ('95th percentile', {'color': 'black', 'linestyle': '--'})]
    save(figure, picture, colored(by(rows, 'predictor'), PREDICTORS) + styles)


def draw_tradeoff(rows, picture):
    recordings = by(rows, 'recording')
    leads = [name for name in rows[0] if name.startswith('warned_')]
    ring = {'linestyle': '', 'marker': 'o', 'fillstyle': 'none', 'markersize': 10, 'markeredgewidth': 2}
    figure, grid = page(len(recordings), len(leads))
    for line, (recording, of_recording) in zip(grid, recordings.items()):
        for axes, lead in zip(line, leads):
            for predictor, some in by(of_recording, 'predictor').items():
                color = PREDICTORS.get(predictor, '#CC79A7')
                chosen = [row for row in some if row['chosen'] == '1']
                axes.plot(column(some, 'false_alarms_per_min'), column(some, lead), '.-', color=color)
                axes.plot(column(chosen, 'false_alarms_per_min'), column(chosen, lead), color=color, **ring)
            axes.set(title=plain(f'{recording}, {lead[7:]} s ahead'), ylabel='contacts warned of', ylim=(0, 1.03))
            axes.set_xlim(left=0)
    for axes in grid[-1]:
        axes.set_xlabel('false alarms per minute')
    chosen = [row['min_probability'] for row in rows if row['chosen'] == '1']
    rings = [(f'probability {probability}', dict(ring, color='black')) for probability in chosen[:1]]
    save(figure, picture, colored(by(rows, 'predictor'), PREDICTORS) + rings)


def draw_calibration(rows, picture):
    intervals = by(rows, 'within_s')
    figure, grid = page(1, len(intervals), row_height=3.3)
    for axes, (length, of_interval) in zip(grid[0], intervals.items()):
        axes.plot([0, 1], [0, 1], 'k--', linewidth=1)
        for scale, some in by(of_interval, 'scale').items():
            axes.plot(column(some, 'probability'), column(some, 'frequency'), 'o-', color=SCALES.get(scale))
        axes.set(title=f'within {length} s', xlim=(0, 1), ylim=(0, 1), xlabel='probability', ylabel='how often it came')
    save(figure, picture, colored(by(rows, 'scale'), SCALES))


def draw_sessions(rows, picture):
    panels = {'unjustified alarms per minute': ['unjustified_per_min'],
              'alarms before a contact or near miss': ['precision', 'precision_10mm', 'precision_20mm', 'precision_50mm'],
              'contacts warned of ahead': ['warned_0.1', 'warned_0.3', 'warned_0.5', 'warned_1.0']}
    names = [plain(row['recording']) for row in rows]
    figure, grid = page(1, len(panels), row_height=3.8)
    for axes, (title, columns) in zip(grid[0], panels.items()):
        width = 0.8 / len(columns)
        for i, (name, color) in enumerate(zip(columns, COLORS)):
            axes.bar([at + (i - 0.5 * (len(columns) - 1)) * width for at in range(len(rows))], column(rows, name), width, color=color)
        axes.set(title=title, xticks=range(len(rows)))
        axes.set_xticklabels(names, rotation=-20, ha='left', fontsize='small')
    labels = ['contact, 0.1 s', '10 mm, 0.3 s', '20 mm, 0.5 s', '50 mm, 1.0 s']
    save(figure, picture, colored(labels, dict(zip(labels, COLORS)), 8))


def draw_tuning(rows, picture):
    colors = {'0.5 s ahead': '#0072B2', '1.0 s ahead': '#009E73'}
    figure, grid = page(1, 1)
    axes = grid[0][0]
    for label, color in colors.items():
        axes.plot(column(rows, 'unjustified_per_min'), column(rows, f'warned_{label[:3]}'), 'o-', color=color)
    axes.axvline(float(rows[0]['at_most_per_min']), color='black', linestyle='--', linewidth=1)
    axes.set(xlabel='unjustified alarms per minute', ylabel='contacts warned of', ylim=(0, 1.03))
    axes.set_xlim(left=0)
    save(figure, picture, colored(colors, colors))


def draw_stages(rows, picture):
    bars = by(rows, 'triangles', 'method')
    figure, grid = page(1, 1, row_height=0.8 + 0.45 * len(bars), width=9)
    axes = grid[0][0]
    names = [f'{triangles} triangles, {method}' for triangles, method in bars]
    left = [0.0] * len(bars)
    colors = {}
    for (stage, some), color in zip(by(rows, 'stage').items(), COLORS):
        colors[stage] = color
        shares = column(some, 'percent_of_a_processor')
        axes.barh(names, shares, left=left, color=color)
        left = [a + b for a, b in zip(left, shares)]
    axes.invert_yaxis()
    axes.set_xlabel("[%] of one processor's time")
    save(figure, picture, colored(colors, colors, 8), fontsize='small')


def draw_latency(rows, picture):
    sizes, methods = by(rows, 'triangles'), by(rows, 'method')
    figure, grid = page(len(sizes), len(methods), width=1 + 6 * len(methods), sharex=True)
    for line, size in zip(grid, sizes):
        for axes, method in zip(line, methods):
            for work, color in LATENCIES.items():
                some = [row for row in sizes[size] if row['method'] == method and row['work'] == work]
                middles = column(some, 'middle')
                edges = [middle / HALF_CLASS for middle in middles] + [middle * HALF_CLASS for middle in middles[-1:]]
                percents = [100 * share for share in column(some, 'share')]
                axes.step(edges[:1] + edges, [0] * bool(some) + percents + [0] * bool(some), where='post', color=color, linewidth=2)
            axes.set(xscale='log', xlim=(0.03, 1000), ylabel='%', title=f'{size} triangles, {method}')
            axes.set_ylim(bottom=0)
            write_numbers(axes.xaxis)
    for axes in grid[-1]:
        axes.set_xlabel('[ms]')
    save(figure, picture, colored(LATENCIES, LATENCIES))


def looks_of(methods):
    """Returns the look of each method: each has a marker, from the tenth on they are dashed."""
    looks = dict(READS)
    lines = itertools.product(('-', '--', '-.'), METHODS)
    for method, (line, color), marker in zip((name for name in methods if name not in READS), lines, itertools.cycle('os^vD<>pPX*hd8')):
        looks[method] = {'color': color, 'linestyle': line, 'marker': marker, 'capsize': 2}
    return looks


def draw_times(rows, picture):
    panels = by([row for row in rows if row['work'] in ('ordered', 'shuffled')], 'work', 'queries')
    if not panels:
        raise ValueError('no detectors are compared')
    looks = looks_of(by(sorted(rows, key=lambda row: row['method'] != 'halfspace'), 'method'))
    figure, grid = page(math.ceil(len(panels) / 2), 2, row_height=7, width=22)
    for axes, ((work, queries), of_panel) in zip(grid.flat, panels.items()):
        lines = {method: sorted(some, key=lambda row: float(row['triangles'])) for method, some in by(of_panel, 'method').items()}
        # The key begins with the method that takes most time per triangle.
        for method, some in sorted(lines.items(), key=lambda line: -float(line[1][-1]['median_us']) / float(line[1][-1]['triangles'])):
            median, low, high = (column(some, name) for name in ('median_us', 'p10_us', 'p90_us'))
            spread = [[b - a for a, b in zip(low, median)], [b - a for a, b in zip(median, high)]]
            axes.errorbar(column(some, 'triangles'), median, None if method in READS else spread, label=method, **looks[method])
        axes.set(xscale='log', yscale='log', xlabel='triangles', title=f'{work} mesh',
                 ylabel=f'update and {queries} {"query" if queries == "1" else "queries"} [µs], median, p10 to p90')
        axes.legend(loc='upper left', bbox_to_anchor=(1, 1), frameon=False)
    save(figure, picture, [])


# A column that only this kind of file has.
KINDS = {'horizon_s': draw_errors, 'min_probability': draw_tradeoff, 'frequency': draw_calibration, 'precision_10mm': draw_sessions,
         'at_most_per_min': draw_tuning, 'percent_of_a_processor': draw_stages, 'extras': draw_times}


def draw_file(path, picture):
    if path.endswith('.tsv'):
        draw = draw_latency
        rows = rows_of(path, delimiter='\t', fieldnames=['method', 'triangles', 'work', 'middle', 'share'])
    else:
        rows = rows_of(path)
        draw = next((kind for name, kind in KINDS.items() if rows and name in rows[0]), None)
    if not draw or not rows:
        raise ValueError(f'{path}: nothing in it can be drawn')
    draw(rows, picture)


def draw_timeline(levels, collisions, contacts, name, picture):
    figure, grid = page(3, 1, sharex=True)
    level_axes, collision_axes, lead_axes = grid[:, 0]
    names = list(LEVELS)
    begins = column(levels, 'begin_s')
    lasts = [end - begin for begin, end in zip(begins, column(levels, 'end_s'))]
    level_axes.barh([names.index(row['level']) for row in levels], lasts, left=begins, color=[LEVELS[row['level']] for row in levels])
    level_axes.set(title=plain(f'Level of the warning: {name}'), yticks=range(len(names)), ylim=(-0.6, 4.6))
    level_axes.set_yticklabels(names)
    # A time that is not known interrupts the line.
    collision_axes.plot(column(collisions, 'received_s'), column(collisions, 'time_to_collision_s'), '.-', color='#0072B2')
    collision_axes.set(title='Time until the predicted path meets a workpiece (0: in contact; no line: it meets none)', ylabel='[s]')
    highest = max([1.0] + [time for time in column(collisions, 'time_to_collision_s') if not math.isnan(time)])
    collision_axes.set_ylim(-0.05, 1.05 * highest)
    times = column(contacts, 'begin_s')
    leads = column(contacts, 'considered_lead_s')
    lead_axes.vlines(times, 0, leads, color=LEVELS['CONSIDERED'], linewidth=6)
    lead_axes.vlines(times, 0, column(contacts, 'reflex_lead_s'), color=LEVELS['REFLEX'], linewidth=6)
    for row, time, lead in zip(contacts, times, leads):
        lead_axes.annotate(row['contact'], (time, lead), (0, 4), textcoords='offset points', ha='center', clip_on=True)
    if not contacts:
        lead_axes.text(0.5, 0.5, 'no contact', ha='center', transform=lead_axes.transAxes)
    lead_axes.set(title='Lead of the warnings before each contact (numbers: contacts.png; no bar: no warning before it)', ylabel='[s]',
                  xlabel='time since the session began [s]', ylim=(0, max([0.2] + [1.15 * lead for lead in leads])))
    lead_axes.set_xlim(0, max([0.01] + column(levels, 'end_s')))
    save(figure, picture, colored(LEVELS, LEVELS, 8))


def printable(name):
    name = ''.join(letter if letter.isprintable() else '?' for letter in name)
    return plain(name if len(name) <= 24 else name[:24] + '...')


def contact_cells(row):
    begin, end, depth = (float(row[name]) for name in ('begin_s', 'end_s', 'depth_mm'))
    leads = [f'{float(row[name]):.2f} s' if float(row[name]) > 0 else 'none' for name in ('considered_lead_s', 'reflex_lead_s')]
    return [row['contact'], f'{begin:.2f}', f'{end - begin:.2f}', printable(row['mesh']), printable(row['tool_link']),
            row['triangles'], '-' if math.isnan(depth) else f'{depth:.1f}'] + leads


def draw_contacts(contacts, name, picture):
    headings = ['#', 'begin [s]', 'lasts [s]', 'workpiece', 'link of the tool', 'triangles', 'depth [mm]', 'CONSIDERED', 'REFLEX']
    places = [0.054, 0.146, 0.238, 0.269, 0.462, 0.688, 0.781, 0.892, 0.969]  # of the aligned sides, in widths of the picture
    lines = [contact_cells(row) for row in contacts[:MAX_CONTACTS]]
    more = len(contacts) - len(lines)
    figure, grid = page(1, 1, row_height=0.2 + 0.3 * (1 + max(len(lines), 1) + (more > 0)))
    axes = grid[0][0]
    axes.set_position((0, 0, 1, 1))
    axes.axis('off')
    height = figure.get_figheight()
    figure.suptitle(plain(f'Contacts of {name} and leads of CONSIDERED and REFLEX'), y=1 - 0.2 / height)

    def write(text, line, place, **options):
        axes.text(place, 1 - (KEY + 0.15 + 0.3 * line) / height, text, va='center', **options)
    for i, line in enumerate([headings] + lines):
        if i > 0 and i % 2 == 0:
            axes.axhspan(1 - (KEY + 0.3 * i) / height, 1 - (KEY + 0.3 * (i + 1)) / height, 0.023, 0.977, color='#eeeeee')
        for j, (cell, place) in enumerate(zip(line, places)):
            write(cell, i, place, ha='left' if j in (3, 4) else 'right', weight='normal' if i else 'bold')
    axes.plot([0.023, 0.977], [1 - (KEY + 0.3) / height] * 2, 'k')
    axes.set(xlim=(0, 1), ylim=(0, 1))
    if not lines:
        write('no contact', 1, 0.5, ha='center')
    if more > 0:
        write(f'... and {more} more in contacts.csv', 1 + len(lines), places[3], style='italic')
    figure.savefig(picture)


def view_from(areas):
    """Returns the axes to the right, up and to the viewer: who looks from where the areas face, but a little from the side."""
    import numpy
    total = areas.sum(axis=0)
    size = numpy.linalg.norm(total)
    x, y, z = total / size if size > 1e-12 else (0.0, 0.0, 1.0)
    tilt = min(math.acos(max(-1.0, min(1.0, z))) + math.radians(25), math.pi)
    turn = math.atan2(x, -y)
    right = numpy.array([math.cos(turn), math.sin(turn), 0])
    front = numpy.array([math.sin(tilt) * math.sin(turn), -math.sin(tilt) * math.cos(turn), math.cos(tilt)])
    return right, numpy.cross(front, right), front


def draw_surface(figure, axes, corners, touched, values, ends):
    """Draws triangles.
    corners   [m], by triangle
    touched   which of them are touched
    values    of these, from 0 to 1; nan: no color
    ends      texts at 0 and 1"""
    import numpy
    from matplotlib.cm import ScalarMappable
    from matplotlib.collections import PolyCollection
    from matplotlib.colors import LinearSegmentedColormap, Normalize
    places = [0, -UNTOUCHED - 1e-3, -UNTOUCHED] + [step - UNTOUCHED for step in (0.2, 0.4, 0.6, 0.8, 1.0)]
    colors = LinearSegmentedColormap.from_list('touches', [(place / (1 - UNTOUCHED), color) for place, color in zip(places, TOUCH_COLORS)])
    scale = ScalarMappable(Normalize(UNTOUCHED, 1), colors)
    scale.set_array([])
    of_all = numpy.full(len(corners), UNTOUCHED)
    of_all[touched] = numpy.where(numpy.isnan(values), UNTOUCHED, values)
    areas = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    right, up, front = view_from(areas[touched])
    order = numpy.argsort((corners @ front).sum(axis=1))  # the nearest last
    flat = numpy.stack([corners @ right, corners @ up], axis=2)
    axes.add_collection(PolyCollection(flat[order], facecolors=scale.to_rgba(of_all[order]), edgecolors='#999999', linewidths=0.2))
    axes.autoscale()
    axes.set_aspect('equal')
    bar = figure.colorbar(scale, ax=axes, ticks=[UNTOUCHED, 0, 1], shrink=0.5, fraction=0.05)
    bar.ax.set_yticklabels(['none'] + list(ends))


def draw_touches(touches, surfaces, name, picture):
    import numpy
    workpieces = list(by(touches, 'mesh').items())[:MAX_WORKPIECES]
    surfaces = by(surfaces, 'mesh')
    figure, grid = page(max(len(workpieces), 1), 2, row_height=4.8)
    figure.suptitle(plain(name), y=1 - 0.2 / figure.get_figheight())
    for axes in grid.flat:
        axes.axis('off')
    for line, (mesh, rows) in zip(grid, workpieces):
        sweeps, depths = numpy.array(column(rows, 'sweeps')), numpy.array(column(rows, 'depth_mm'))
        deepest = max([0.0] + [depth for depth in depths if not math.isnan(depth)])
        panels = [('sweeps that touched a triangle', numpy.log(sweeps) / max(math.log(sweeps.max()), 1e-9), ('1', f'{sweeps.max():.0f}')),
                  ('largest depth [mm]', depths / (deepest or 1.0), ('0', f'{deepest:.1f}'))]
        shape = surfaces.get(mesh, [])
        corners = numpy.array([[float(row[axis + corner]) for axis in 'xyz'] for row in shape for corner in '123']).reshape(-1, 3, 3)
        index = {row['triangle']: i for i, row in enumerate(shape)}
        for axes, (title, values, ends) in zip(line, panels):
            axes.set_title(plain(f'{mesh}: {title}'))
            if shape:
                draw_surface(figure, axes, corners, [index[row['triangle']] for row in rows], values, ends)
            else:
                axes.text(0.5, 0.5, 'not drawn: see touches.csv', ha='center', transform=axes.transAxes)
    if not workpieces:
        figure.text(0.5, 0.5, 'nothing was touched', ha='center')
    save(figure, picture, [])


def draw_replay(folder, name):
    levels, collisions, contacts, touches, surfaces = (rows_of(os.path.join(folder, f'{table}.csv')) for table in (
        'levels', 'collisions', 'contacts', 'touches', 'surfaces'))
    draw_timeline(levels, collisions, contacts, name, os.path.join(folder, 'timeline.png'))
    draw_contacts(contacts, name, os.path.join(folder, 'contacts.png'))
    draw_touches(touches, surfaces, name, os.path.join(folder, 'touches.png'))


def main(arguments):
    if len(arguments) != 2:
        raise ValueError('usage: plot.py FILE PICTURE, or plot.py FOLDER NAME')
    (draw_replay if os.path.isdir(arguments[0]) else draw_file)(*arguments)


if __name__ == '__main__':
    try:
        main(sys.argv[1:])
    except ImportError as error:
        print(f'plot.py: no pictures: {error}; install python3-matplotlib', file=sys.stderr)
        sys.exit(2)
    except KeyError as error:
        print(f'plot.py: {sys.argv[1]}: {error} is unknown', file=sys.stderr)
        sys.exit(2)
    except (ValueError, OSError, csv.Error) as error:
        print(f'plot.py: {error}', file=sys.stderr)
        sys.exit(2)
