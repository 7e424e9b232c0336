#!/usr/bin/env python3
"""Publishes a sheet that waves, at 60 Hz: rosrun sweep_guard publish_mesh.py [mesh:=TOPIC mesh_vertices:=TOPIC]"""
import numpy
import rospy
from sweep_guard import MeshPublisher

CELLS = 20  # in each direction
SIDE = 0.4  # [m]
AMPLITUDE = 0.02  # [m]


def grid():
    """Returns the corners of the cells at rest [m], and two triangles for each cell."""
    x, y = numpy.meshgrid(*2 * [numpy.linspace(-SIDE / 2, SIDE / 2, CELLS + 1)])
    vertices = numpy.stack([x, y, numpy.zeros_like(x)], axis=-1).reshape(-1, 3)
    first = (numpy.arange(CELLS)[:, None] * (CELLS + 1) + numpy.arange(CELLS)).ravel()
    right, up, across = first + 1, first + CELLS + 1, first + CELLS + 2
    faces = numpy.concatenate([numpy.stack([first, right, across], axis=1), numpy.stack([first, across, up], axis=1)])
    return vertices, faces


def wave(vertices, time):
    deformed = vertices.copy()
    deformed[:, 2] = AMPLITUDE * numpy.sin(3.0 * time + 20.0 * vertices[:, 0])
    return deformed


def main():
    rospy.init_node('sheet')
    vertices, faces = grid()
    sheet = MeshPublisher('sheet', frame='world', open=True)
    sheet.publish(vertices, faces)
    rate = rospy.Rate(60)
    while not rospy.is_shutdown():
        now = rospy.Time.now()
        sheet.deform(wave(vertices, now.to_sec()), stamp=now)
        rate.sleep()


if __name__ == '__main__':
    try:
        main()
    except rospy.ROSInterruptException:
        pass
