#!/usr/bin/env python3
"""What a MoveIt planning scene holds after random messages, told apart from the code under test.

  planning_scene_oracle.py COUNT SEED [--old]   prints COUNT steps, each followed by what the scene must hold after it

--old: the objects have no pose of their own, as in MoveIt before 1.1. Of a step the words are, in this order:
  await
  object OBJECT
  attached LINK OBJECT
  scene IS_DIFF IS_STATE_DIFF NAMES_JOINTS COUNT (LINK OBJECT)... COUNT OBJECT...
of an OBJECT
  ID FRAME OPERATION POSES POSE... COUNT SURFACE... COUNT POSE... COUNT SURFACE... COUNT POSE...
that is its own pose, if it has one, its primitives and their poses, and its meshes and theirs; of a SURFACE
  COUNT (X Y Z)... COUNT (A B C)...
and of a POSE X Y Z QX QY QZ QW. After each step follows
  expect NEEDS_FULL_SCENE COUNT (ID LINK FRAME SURFACE)...
An empty name is written as -, and the frame of what is refused, too.
"""
import argparse
import random

IDS = 'abcdefgh'
FRAMES = ('world', 'base')
LINKS = ('hand', 'arm')
UNSET = (0.0,) * 7
IDENTITY = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
BOX = ((0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6),
       (1, 3, 5), (3, 7, 5))
TETRAHEDRON = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))


# Steps. An object is a dictionary with the names of moveit_msgs/CollisionObject; `pose` is None before MoveIt 1.1. A
# primitive is the size of a box, a mesh is its vertices and triangles.


class Steps:
    """Draws steps; keeps how many shapes each object may have."""

    def __init__(self, seed, old):
        self.random = random.Random(seed)
        self.old = old
        self.shapes = dict.fromkeys(IDS, 1)

    def chance(self, probability):
        return self.random.random() < probability

    def numbers(self, count):
        return tuple(self.random.uniform(-1.0, 1.0) for _ in range(count))

    def pose(self):
        x, y, z, w = self.numbers(4)
        length = (x * x + y * y + z * z + w * w) ** 0.5 or 1.0
        turn = (0.0, 0.0, 0.0, 0.0) if self.chance(0.1) else (x / length, y / length, z / length, w / length)
        return self.numbers(3) + turn

    def object_pose(self):
        if self.old:
            return None
        return self.random.choice((UNSET, IDENTITY, self.pose(), self.pose(), self.pose()))

    def poses(self, count):
        """Mostly one for each shape."""
        wrong = self.random.choice((-1, 1)) if self.chance(0.08) else 0
        return [self.pose() for _ in range(max(count + wrong, 0))]

    def blank(self, name, operation):
        return {'id': name, 'frame': self.random.choice(FRAMES), 'operation': operation, 'pose': self.object_pose(),
                'primitives': [], 'primitive_poses': [], 'meshes': [], 'mesh_poses': []}

    def shaped(self, name, operation):
        message = self.blank(name, operation)
        count = 0 if self.chance(0.05) else self.random.randint(1, 3)
        boxes = self.random.randint(0, count)
        message['primitives'] = [tuple(abs(n) for n in self.numbers(3)) for _ in range(boxes)]
        message['primitive_poses'] = self.poses(boxes)
        message['meshes'] = [([self.numbers(3) for _ in range(4)], TETRAHEDRON) for _ in range(count - boxes)]
        message['mesh_poses'] = self.poses(count - boxes)
        self.shapes[name] = count + (self.shapes[name] if operation == 'APPEND' else 0)
        return message

    def moved(self, name):
        message = self.shaped(name, 'MOVE') if self.chance(0.1) else self.blank(name, 'MOVE')
        count = self.shapes[name] if self.old or self.chance(0.4) else 0
        boxes = self.random.randint(0, count)
        message.update(primitive_poses=[self.pose() for _ in range(boxes)], mesh_poses=self.poses(count - boxes))
        return message

    def object(self):
        name = self.random.choice(IDS)
        operation = self.random.choices(('ADD', 'MOVE', 'APPEND', 'REMOVE', 'REMOVE all'), (40, 30, 15, 13, 2))[0]
        if operation == 'MOVE':
            return self.moved(name)
        if operation in ('ADD', 'APPEND'):
            return self.shaped(name, operation)
        return self.blank(name if operation == 'REMOVE' else '', 'REMOVE')

    def attached(self, operations=('ADD', 'ADD known', 'APPEND', 'MOVE', 'REMOVE', 'REMOVE all')):
        name = self.random.choice(IDS)
        link = '' if self.chance(0.05) else self.random.choice(LINKS)
        operation = self.random.choices(operations, (35, 25, 5, 3, 25, 7)[:len(operations)])[0]
        if operation in ('ADD', 'APPEND'):
            return {'link': link, 'object': self.shaped(name, operation)}
        if operation.startswith('REMOVE'):
            link = '' if self.chance(0.6) else link
            return {'link': link, 'object': self.blank(name if operation == 'REMOVE' else '', 'REMOVE')}
        return {'link': link, 'object': self.blank(name, operation.split()[0])}

    def full_scene(self):
        objects = [self.shaped(name, 'ADD') for name in IDS if self.chance(0.5)]
        attached = [self.attached(('ADD', 'ADD known')) for _ in range(self.random.randint(0, 2))]
        return {'type': 'scene', 'is_diff': False, 'is_state_diff': self.chance(0.2), 'names_joints': self.chance(0.8),
                'attached': attached, 'objects': objects}

    def diff(self):
        attached = [self.attached() for _ in range(self.random.choice((0, 0, 1, 2)))]
        return {'type': 'scene', 'is_diff': True, 'is_state_diff': self.chance(0.8), 'names_joints': self.chance(0.5),
                'attached': attached, 'objects': [self.object() for _ in range(self.random.randint(0, 4))]}

    def step(self):
        kind = self.random.choices(('object', 'attached', 'diff', 'full', 'await'), (55, 17, 20, 7, 1))[0]
        if kind == 'object':
            return {'type': 'object', 'object': self.object()}
        if kind == 'attached':
            return dict(self.attached(), type='attached')
        if kind == 'await':
            return {'type': 'await'}
        return self.diff() if kind == 'diff' else self.full_scene()


def random_steps(count, seed, old=False):
    steps = Steps(seed, old)
    return [steps.step() for _ in range(count)]


# The scene. A pose is (x, y, z, qx, qy, qz, qw), a surface is (vertices, triangles).


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def moved(point, pose):
    axis, w = pose[3:6], pose[6]
    if pose[3:] == (0.0, 0.0, 0.0, 0.0):  # not set: no turn
        return tuple(p + t for p, t in zip(point, pose))
    once = cross(axis, point)
    twice = cross(axis, once)
    return tuple(p + 2.0 * w * a + 2.0 * b + t for p, a, b, t in zip(point, once, twice, pose))


def box(size):
    corners = [tuple(0.5 * side if i >> axis & 1 else -0.5 * side for axis, side in enumerate(size)) for i in range(8)]
    return corners, BOX


class Held:
    """An object as the scene has it: shapes are pairs of a surface and its pose in the object."""

    def __init__(self, message):
        self.frame = message['frame']
        self.pose = message['pose'] or IDENTITY
        surfaces = [box(size) for size in message['primitives']]
        poses = padded(message['primitive_poses'], len(surfaces))
        surfaces += message['meshes']
        self.shapes = list(zip(surfaces, padded(poses + message['mesh_poses'], len(surfaces))))
        self.is_lost = False
        if len(surfaces) == 1 and message['pose'] == UNSET:
            self.pose = self.shapes[0][1]
            self.shapes = [(surfaces[0], IDENTITY)]

    def surface(self):
        vertices, triangles = [], []
        for (corners, faces), pose in self.shapes:
            triangles += [tuple(len(vertices) + corner for corner in face) for face in faces]
            vertices += [moved(moved(corner, pose), self.pose) for corner in corners]
        return vertices, triangles


def padded(poses, count):
    return poses + [IDENTITY] * (count - len(poses))


def shape_count(message):
    return len(message['primitives']) + len(message['meshes'])


def has_wrong_poses(message):
    pairs = ((message['primitives'], message['primitive_poses']), (message['meshes'], message['mesh_poses']))
    return any(len(poses) > len(shapes) or message['pose'] is None and len(poses) < len(shapes)
               for shapes, poses in pairs)


class Oracle:
    """The scene after the steps that were applied, and whether the last one needs a full scene."""

    def __init__(self, awaits_full_scene=True):
        self.world = {}
        self.attached = {}  # id: link, Held
        self.refused = set()
        self.awaits_full_scene = awaits_full_scene
        self.needs_full_scene = awaits_full_scene

    def apply(self, step):
        self.needs_full_scene = False
        concerned = set()
        if step['type'] == 'await':
            self.awaits_full_scene = True
        elif step['type'] == 'object':
            self._object(step['object'], concerned)
        elif step['type'] == 'attached':
            self._attached(step, concerned)
        else:
            self._scene(step, concerned)
        if self.awaits_full_scene or any(self._is_lost(name) for name in concerned):
            self.needs_full_scene = True

    def objects(self):
        """For each id its link or '', its frame and its surface. What is refused has frame '' and no surface."""
        held = {}
        for name in set(self.world) | set(self.attached) | self.refused:
            link, thing = self.attached.get(name, ('', None))
            twice = name in self.world and name in self.attached
            thing = self.world.get(name, thing)
            if name in self.refused or twice or self.awaits_full_scene or thing.is_lost:
                held[name] = (link, '', ([], []))
            else:
                held[name] = (link, thing.frame, thing.surface())
        return held

    def _is_lost(self, name):
        if name in self.refused or name in self.world and name in self.attached:
            return False
        thing = self.world.get(name) or self.attached.get(name, ('', None))[1]
        return thing is not None and thing.is_lost

    def _scene(self, step, concerned):
        if not step['is_diff']:
            concerned |= self.refused | (set(self.attached) if self.awaits_full_scene else set())
            self.awaits_full_scene = False
            self.refused.clear()
        if step['names_joints'] and not step['is_state_diff']:
            concerned |= set(self.attached)
            self.attached.clear()
        for message in step['attached']:
            if message['object']['operation'] != 'ADD' and not step['is_state_diff']:
                self._refuse(message['object'], concerned)
            else:
                self._attached(message, concerned)
        if not step['is_diff']:
            concerned |= set(self.world)
            self.world.clear()
        for message in step['objects']:
            self._object(message, concerned)

    def _refuse(self, message, concerned):
        concerned.add(message['id'])
        self.refused.add(message['id'])

    def _object(self, message, concerned):
        name, operation = message['id'], message['operation']
        if operation == 'REMOVE' and not name:
            concerned |= set(self.world) | self.refused
            self.world.clear()
            self.refused.clear()
            return
        concerned.add(name)
        known = self.world.get(name)
        if operation == 'REMOVE':
            self.world.pop(name, None)
            is_right = True
        elif operation == 'MOVE':
            is_right = self._move(known, message)
        elif shape_count(message) == 0:
            is_right = False
        elif operation == 'APPEND' and known:
            is_right = not has_wrong_poses(message) and (message['pose'] is not None or message['frame'] == known.frame)
            known.shapes += Held(message).shapes if is_right else []
        else:
            self.needs_full_scene |= operation == 'APPEND'
            self.world.pop(name, None)
            is_right = not has_wrong_poses(message)
            if is_right:
                self.world[name] = Held(message)
        (self.refused.discard if is_right else self.refused.add)(name)

    def _move(self, known, message):
        if known is None:
            self.needs_full_scene = True
            return False
        poses = message['primitive_poses'] + message['mesh_poses']
        is_right = len(poses) == len(known.shapes)
        if message['pose'] is not None or is_right:
            known.frame, known.pose, known.is_lost = message['frame'], message['pose'] or IDENTITY, False
        if is_right:
            known.shapes = [(surface, pose) for (surface, _), pose in zip(known.shapes, poses)]
        return is_right or message['pose'] is not None and not poses

    def _attached(self, step, concerned):
        link, message = step['link'], step['object']
        name, operation = message['id'], message['operation']
        if operation == 'REMOVE':
            for other, (held_by, thing) in list(self.attached.items()):
                if name in ('', other) and link in ('', held_by):
                    thing.is_lost = True
                    self.world.setdefault(other, thing)
                    del self.attached[other]
                    self.refused.discard(other)
                    concerned.add(other)
            return
        from_world = operation == 'ADD' and shape_count(message) == 0 and name in self.world
        self._refuse(message, concerned)
        if operation == 'MOVE' or not link:
            return
        if shape_count(message) == 0 and not from_world:
            self.needs_full_scene = True
        elif not from_world and has_wrong_poses(message):
            pass
        elif operation == 'APPEND' and name in self.attached:
            self.needs_full_scene = True
        else:
            thing = self.world.pop(name, None)
            self.attached[name] = (link, thing if from_world else Held(message))
            self.refused.discard(name)


# Text.


def listed(items, write):
    return [str(len(items))] + [word for item in items for word in write(item)]


def numbers_text(numbers):
    return [repr(number) for number in numbers]


def surface_text(surface):
    return listed(surface[0], numbers_text) + listed(surface[1], numbers_text)


def object_text(message):
    words = [message['id'] or '-', message['frame'], message['operation']]
    words += listed([message['pose']] if message['pose'] else [], numbers_text)
    words += listed([box(size) for size in message['primitives']], surface_text)
    words += listed(message['primitive_poses'], numbers_text)
    return words + listed(message['meshes'], surface_text) + listed(message['mesh_poses'], numbers_text)


def attached_text(message):
    return [message['link'] or '-'] + object_text(message['object'])


def step_text(step):
    words = [step['type']]
    if step['type'] == 'object':
        words += object_text(step['object'])
    elif step['type'] == 'attached':
        words += attached_text(step)
    elif step['type'] == 'scene':
        words += [str(int(step[flag])) for flag in ('is_diff', 'is_state_diff', 'names_joints')]
        words += listed(step['attached'], attached_text) + listed(step['objects'], object_text)
    return ' '.join(words)


def expected_text(oracle):
    words = ['expect', str(int(oracle.needs_full_scene))]
    words += listed(sorted(oracle.objects().items()),
                    lambda held: [held[0] or '-', held[1][0] or '-', held[1][1] or '-'] + surface_text(held[1][2]))
    return ' '.join(words)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('count', type=int)
    parser.add_argument('seed', type=int)
    parser.add_argument('--old', action='store_true')
    arguments = parser.parse_args()
    oracle = Oracle()
    for step in random_steps(arguments.count, arguments.seed, arguments.old):
        oracle.apply(step)
        print(step_text(step))
        print(expected_text(oracle))


if __name__ == '__main__':
    main()
