"""Checks the arrays of a mesh before they are sent: the guard would refuse a bad mesh and be UNKNOWN."""
import numpy

MAX_COORDINATE = 1e7  # [m] as of the guard
MAX_ROUNDING = 0.01  # [m] as of the guard
COARSE_ROUNDING = 0.001  # [m] from which on the diagnostics of the guard say it


def _checked_rows(name, row, rows):
    if rows.ndim != 2 or rows.shape[1] != 3 or len(rows) == 0:
        raise ValueError(f'{name} have shape {rows.shape}: give {row}, in an array of shape (n, 3)')
    return rows


def checked_vertices(vertices):
    """Returns float64 positions [m] of shape (n, 3). Raises ValueError if one is not finite or farther than 1e7 m."""
    array = numpy.asarray(vertices)
    if array.dtype.kind not in 'fiu':
        raise ValueError(f'vertices have dtype {array.dtype}: give real numbers [m], in an array of shape (n, 3)')
    positions = _checked_rows('vertices', 'x, y, z [m] of each vertex', array.astype(numpy.float64))
    bad = numpy.flatnonzero(~(numpy.abs(positions) <= MAX_COORDINATE).all(axis=1))
    if len(bad):
        raise ValueError(f'vertex {bad[0]} is {positions[bad[0]].tolist()}: give finite meters, at most 1e7')
    return positions


def float32_rounding(positions):
    """Returns how far a vertex [m] may be from its position once that is sent as float32: half a step on each axis."""
    largest = numpy.abs(positions).max(axis=0).astype(numpy.float32)
    return float(numpy.linalg.norm(0.5 * numpy.spacing(largest).astype(numpy.float64)))


def coarse_text(mesh_id, rounding):
    """Returns in words that the coordinates of a workpiece are large for float32."""
    return (f"float32 rounds the coordinates of '{mesh_id}' by up to {1e3 * rounding:.1f} mm: "
            'send them in a frame near the workpiece')


def checked_faces(faces, vertex_count):
    """Returns uint32 indices of shape (m, 3). Raises ValueError if one names no vertex."""
    array = numpy.asarray(faces)
    if array.dtype.kind not in 'iu':
        raise ValueError(f'faces have dtype {array.dtype}: give 0-based integer indices, in an array of shape (n, 3)')
    _checked_rows('faces', 'three vertices for each triangle (cut other polygons into triangles)', array)
    bad = numpy.argwhere((array < 0) | (array >= vertex_count))
    if len(bad):
        face = bad[0][0]
        raise ValueError(f'face {face} is {array[face].tolist()}: there are only the vertices 0 to {vertex_count - 1}')
    return array.astype(numpy.uint32)
