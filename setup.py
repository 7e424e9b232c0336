"""Read by catkin_python_setup(): run catkin_make, not this file."""
from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(**generate_distutils_setup(packages=['sweep_guard'], package_dir={'': 'python'}))
