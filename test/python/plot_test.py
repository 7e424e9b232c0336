#!/usr/bin/env python3
"""What scripts/plot.py makes of the CSV files."""
import csv
import importlib.util
import os
import re
import struct
import subprocess
import sys
import tempfile
import unittest

PLOT = os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../scripts/plot.py')
specification = importlib.util.spec_from_file_location('plot', PLOT)
plot = importlib.util.module_from_spec(specification)
specification.loader.exec_module(plot)

FILES = {
    'errors.csv': 'recording,predictor,horizon_s,position_median_m,position_p95_m,rotation_median_rad,rotation_p95_rad,samples\n'
                  'a $b$,direct,0.1,0.001,0.004,0.01,0.02,7\na $b$,direct,1,0.01,0.04,0.1,0.2,7\n',
    'tradeoff.csv': 'recording,predictor,min_probability,false_alarms_per_min,warned_0.1,warned_0.5,warned_1.0,chosen\n'
                    'a,direct,0.1,2,1,0.9,0.5,1\na,direct,0.2,1,1,0.8,0.4,0\n',
    'calibration.csv': 'within_s,scale,probability,frequency\n0.1,the guard,0.1,0.2\n0.1,the guard,0.9,nan\n',
    'sessions.csv': 'recording,minutes,contacts,warned_0.1,warned_0.3,warned_0.5,warned_1.0,unjustified_per_min,precision,'
                    'precision_10mm,precision_20mm,precision_50mm,false_on_share\nall,1,2,1,1,1,0.5,2.5,nan,0.6,0.7,0.8,0.1\n',
    'tuning.csv': 'considered_on,considered_off,reflex_probability,unjustified_per_min,precision,warned_0.1,warned_0.3,warned_0.5,'
                  'warned_1.0,late,false_on_share,at_most_per_min\n0.1,0.1,0.5,2,0.5,1,1,0.9,0.8,0,0.1,2.5\n',
    'stages.csv': 'triangles,method,stage,percent_of_a_processor\n1600,tcpros,sweep,3\n1600,tcpros,predict,2\n',
    'times.csv': 'work,method,triangles,queries,median_us,p10_us,p90_us,ratio_median,ratio_p10,misses,extras\n'
                 'ordered,memory read,400,1,0.5,,,,,,\nordered,halfspace,400,1,5,4,7,,,0,0\nordered,scalar,400,1,9,8,12,2,1.8,0,0\n'
                 'ordered,halfspace,1600,1,6,5,8,,,0,0\nset up,halfspace,400,0,90,80,95,,,,\n',
    'latency.tsv': 'tcpros\t1600\tpose to contacts\t1\t0.5\ntcpros\t1600\tpose to contacts\t1.1\t0.5\n'}
CONTACTS = 'contact,begin_s,end_s,stamp_s,mesh,tool_link,triangles,depth_mm,considered_lead_s,reflex_lead_s'
REPORT = {'levels': 'begin_s,end_s,level,text', 'collisions': 'received_s,time_to_collision_s', 'contacts': CONTACTS,
          'touches': 'mesh,revision,triangle,sweeps,depth_mm', 'surfaces': 'mesh,triangle,x1,y1,z1,x2,y2,z2,x3,y3,z3'}


def contact(number):
    return [number, 6.2, 7, 106, "operator's\n{liver}_\\1 $" + 50 * 'ä', 'tip', 3, 'nan', 1.2, 0.2]


def run(*arguments, **environment):
    return subprocess.run([sys.executable, PLOT, *arguments], env={**os.environ, **environment}, stderr=subprocess.PIPE,
                          universal_newlines=True, check=False)


class LevelsTest(unittest.TestCase):
    def test_the_levels_have_the_colors_of_the_guard(self):
        with open(os.path.join(os.path.dirname(PLOT), '../include/sweep_guard/common/warning_level.h')) as header:
            styles = re.findall(r'{"(\w+)", {(\d+), (\d+), (\d+)}}', header.read())
        self.assertEqual({name: '#' + ''.join(f'{int(part):02x}' for part in rgb) for name, *rgb in styles}, plot.LEVELS)


class PlotTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def height(self, name):
        with open(self.path(name), 'rb') as file:
            begin = file.read(24)
        self.assertEqual(begin[1:4], b'PNG')
        return struct.unpack('>I', begin[20:])[0]

    def write_report(self, **tables):
        for name, columns in REPORT.items():
            with open(self.path(f'{name}.csv'), 'w', newline='', encoding='utf-8') as file:
                csv.writer(file).writerows([columns.split(',')] + tables.get(name, []))

    def texts_of_touches(self, touches, surfaces):
        """Returns all that is written in the picture."""
        texts = []
        self.addCleanup(setattr, plot, 'save', plot.save)
        plot.save = lambda figure, picture, key: texts.extend(
            text.get_text() for axes in figure.axes for text in axes.get_yticklabels() + [axes.title] + axes.texts)
        plot.draw_touches(touches, surfaces, 'session', '')
        return texts

    def test_draws_each_kind_of_file(self):
        for name, text in FILES.items():
            with open(self.path(name), 'w', encoding='utf-8') as file:
                file.write(text)
            plot.main([self.path(name), self.path('picture.png')])
            self.assertGreater(self.height('picture.png'), 100)
            os.remove(self.path('picture.png'))

    def test_draws_a_report_in_which_nothing_happened(self):
        self.write_report()
        plot.main([self.folder, 'session'])
        for name in ('timeline.png', 'contacts.png', 'touches.png'):
            self.assertGreater(self.height(name), 100)

    def test_draws_a_report(self):
        self.write_report(levels=[[0, 1, 'CLEAR', ''], [1, 7, 'CONTACT', 'x']], collisions=[[0.5, ''], [1, 0.5]], contacts=[contact(1)],
                          touches=[['$b', 1, 4, 12, 2.5]], surfaces=[['$b', 4, 0, 0, 0, 1, 0, 0, 0, 1, 0]])
        done = run(self.folder, "operator's $.bag")
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        for name in ('timeline.png', 'contacts.png', 'touches.png'):
            self.assertGreater(os.path.getsize(self.path(name)), 10000)

    def test_the_table_of_contacts_grows_up_to_forty_lines(self):
        heights = []
        for count in (1, 10, 40, 60, 70):
            self.write_report(contacts=[contact(1 + i) for i in range(count)])
            plot.draw_contacts(plot.rows_of(self.path('contacts.csv')), 'session', self.path('contacts.png'))
            heights.append(self.height('contacts.png'))
        self.assertEqual(heights, sorted(heights))
        self.assertEqual(len(set(heights)), 4)
        self.assertLess(heights[-1], 1500)

    def test_a_name_stays_in_its_cell(self):
        self.write_report(contacts=[contact(1)])
        cell = plot.contact_cells(plot.rows_of(self.path('contacts.csv'))[0])[3]
        self.assertEqual(cell, "operator's?{liver}_\\1 \\$ä...")

    def test_the_scales_of_touches_end_at_the_largest_values(self):
        triangles = ['0', '1', '2']
        touches = [{'mesh': 'roof', 'triangle': triangle, 'sweeps': sweeps, 'depth_mm': depth}
                   for triangle, sweeps, depth in zip(triangles, ('1', '1501', '3'), ('6.04', 'nan', '1'))]
        corners = dict(zip(('x1', 'y1', 'z1', 'x2', 'y2', 'z2', 'x3', 'y3', 'z3'), '000100010'))
        texts = self.texts_of_touches(touches, [{'mesh': 'roof', 'triangle': triangle, **corners} for triangle in triangles])
        self.assertEqual([text for text in texts if text in ('none', '1', '1501', '0', '6.0')], ['none', '1', '1501', 'none', '0', '6.0'])

    def test_what_has_no_shape_is_not_drawn(self):
        texts = self.texts_of_touches([{'mesh': 'roof', 'triangle': '0', 'sweeps': '1', 'depth_mm': 'nan'}], [])
        self.assertEqual(texts.count('not drawn: see touches.csv'), 2)

    def test_says_what_it_lacks(self):
        os.mkdir(self.path('matplotlib'))
        with open(self.path('matplotlib/__init__.py'), 'w', encoding='utf-8') as file:
            file.write('raise ImportError("No module named matplotlib")')
        self.write_report()
        done = run(self.folder, 'session', PYTHONPATH=self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr, 'plot.py: no pictures: No module named matplotlib; install python3-matplotlib\n')

    def test_draws_a_trade_off_without_a_chosen_threshold(self):
        with open(self.path('tradeoff.csv'), 'w', encoding='utf-8') as file:
            file.write(FILES['tradeoff.csv'].replace('0.5,1\n', '0.5,0\n'))
        plot.main([self.path('tradeoff.csv'), self.path('picture.png')])
        self.assertGreater(self.height('picture.png'), 100)

    def test_what_cannot_be_read_is_status_two_and_one_line(self):
        errors = FILES['errors.csv']
        for text in (errors.replace('0.004', 'far'), errors[:-len('0.2,7\n')], errors.replace('direct', 200000 * 'x'),
                     errors.replace('position_p95_m', 'p95')):
            with open(self.path('errors.csv'), 'w', encoding='utf-8') as file:
                file.write(text)
            done = run(self.path('errors.csv'), self.path('errors.png'))
            self.assertEqual(done.returncode, 2)
            self.assertRegex(done.stderr, r'^plot\.py: [^\n]+\n$')

    def test_refuses_a_file_of_another_kind(self):
        for text in ('', 'a,b\n', 'a,b\n1,2\n'):
            with open(self.path('other.csv'), 'w', encoding='utf-8') as file:
                file.write(text)
            with self.assertRaisesRegex(ValueError, 'other.csv: nothing in it can be drawn'):
                plot.main([self.path('other.csv'), self.path('other.png')])


if __name__ == '__main__':
    unittest.main()
