#!/usr/bin/env python3
"""Writes the depth images of a folder for check_depth_images.

FOLDER has images as 16-bit PNG and intrinsics.yaml, here or in the folder above. Where NAME.pose.txt is beside
NAME.depth.png, it is the pose of the camera (3 or 4 rows of 4 numbers); else, and with --still, the camera rests.
"""
import argparse
import pathlib
import sys

import numpy
import yaml
from PIL import Image


def intrinsics_of(folder):
    for place in (folder, folder.parent):
        if (place / 'intrinsics.yaml').exists():
            return yaml.safe_load((place / 'intrinsics.yaml').read_text())
    sys.exit(f'{folder}: there is no intrinsics.yaml with fx, fy, cx, cy and depth_unit_m, nor above it')


def pose_of(image, still):
    path = image.with_name(image.name.replace('.depth.png', '.pose.txt'))
    if still or path == image or not path.exists():
        return numpy.eye(4)[:3]
    pose = numpy.loadtxt(path)[:3]
    left, _, right = numpy.linalg.svd(pose[:, :3])
    pose[:, :3] = left @ right
    return pose


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('folder', type=pathlib.Path)
    parser.add_argument('--still', action='store_true', help='as if the camera rested')
    parser.add_argument('--first', type=int, default=0, metavar='N', help='skip the first N images')
    parser.add_argument('--count', type=int, metavar='N', help='take N images')
    given = parser.parse_args()
    camera = intrinsics_of(given.folder)
    images = sorted(given.folder.glob('*.png'))[given.first:]
    for image in images[:given.count]:
        if '.color.' in image.name:
            continue
        depths = numpy.array(Image.open(image)).astype('<u2')
        numbers = [camera['depth_unit_m'], camera['fx'], camera['fy'], camera['cx'], camera['cy']]
        numbers += list(pose_of(image, given.still).flatten())
        text = ' '.join(repr(float(number)) for number in numbers)
        sys.stdout.buffer.write(f'{depths.shape[1]} {depths.shape[0]} {text}\n'.encode() + depths.tobytes())


if __name__ == '__main__':
    main()
