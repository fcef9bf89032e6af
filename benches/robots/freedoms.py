"""Freedoms by twists and singular values: at the closed pose, and at closed poses nearby.

One column per joint variable, six rows per loop, one per linear equation. Nothing here is shared with the program: other
equations (the error of a loop as one twist, not a product of displacements around a basic cycle), other decompositions, double
precision only. Where singular values leave no gap the answer is `None`.
"""

import math

import numpy as np

from description import rotation

# A singular value below this share of the largest counts as zero; one between this and a hundred times as much is no answer.
ZERO = 1e-8
UNCLEAR = 1e-6
NEARBY = 5
RESTARTS = 20


def displacement(freedom, value):
    kind, axis, pitch = freedom
    axis = axis / np.linalg.norm(axis)
    found = np.eye(4)
    if kind == "P":
        found[:3, 3] = axis * value
    else:
        found[:3, :3] = rotation(axis, value)
        found[:3, 3] = axis * pitch * value
    return found


def screw(freedom, pose):
    """In world coordinates, angular part first."""
    kind, axis, pitch = freedom
    along = pose[:3, :3] @ (axis / np.linalg.norm(axis))
    if kind == "P":
        return np.r_[0, 0, 0, along]
    return np.r_[along, np.cross(pose[:3, 3], along) + pitch * along]


class Equations:
    def __init__(self, robot):
        self.robot = robot
        self.columns, count = {}, 0
        for joint in robot.tree + robot.loops:
            self.columns[joint.name] = (count, count + len(joint.freedoms))
            count += len(joint.freedoms)
        self.count = count
        placed = {joint.b for joint in robot.tree}
        self.roots = [link for link in robot.links if link not in placed]
        self.children = {}
        for joint in robot.tree:
            self.children.setdefault(joint.a, []).append(joint)
        self.parent = {joint.b: joint for joint in robot.tree}
        self.equations = [
            (factors, offset)
            for factors, offset in robot.equations
            if all(name in self.columns and np.diff(self.columns[name])[0] == 1 for name in factors)
        ]
        poses, _ = self.poses(np.zeros(count))
        points = np.array([pose[:3, 3] for pose in poses.values()])
        self.length = max(math.sqrt(((points - points.mean(0)) ** 2).sum(1).mean()), 1e-3)
        self.unit = np.ones(count)
        for joint in robot.tree + robot.loops:
            start, _ = self.columns[joint.name]
            for i, (kind, _, _) in enumerate(joint.freedoms):
                self.unit[start + i] = self.length if kind == "P" else 1.0

    def across(self, joint, pose, values, screws):
        start, _ = self.columns[joint.name]
        for i, freedom in enumerate(joint.freedoms):
            screws[:, start + i] = screw(freedom, pose)
            pose = pose @ displacement(freedom, values[start + i])
        return pose

    def poses(self, values):
        screws = np.zeros((6, self.count))
        poses = {link: np.eye(4) for link in self.roots}
        stack = list(self.roots)
        while stack:
            link = stack.pop()
            for joint in self.children.get(link, []):
                pose = self.across(joint, poses[link] @ joint.frame_a, values, screws)
                poses[joint.b] = pose @ np.linalg.inv(joint.frame_b)
                stack.append(joint.b)
        return poses, screws

    def on_path(self, link):
        while link in self.parent:
            yield self.columns[self.parent[link].name]
            link = self.parent[link].a

    def at(self, values):
        """The Jacobian and the error, both without unit."""
        poses, screws = self.poses(values)
        rows, errors = [], []
        weight = np.array([1, 1, 1, 1 / self.length, 1 / self.length, 1 / self.length])
        for joint in self.robot.loops:
            own = np.zeros((6, self.count))
            reached = self.across(joint, poses[joint.a] @ joint.frame_a, values, own)
            wanted = poses[joint.b] @ joint.frame_b
            for sign, link in ((1, joint.a), (-1, joint.b)):
                for start, end in self.on_path(link):
                    own[:, start:end] += sign * screws[:, start:end]
            at = wanted[:3, 3]
            own[3:] += np.cross(own[:3].T, at).T
            rows.append(own * self.unit * weight[:, None])
            turn = reached[:3, :3] @ wanted[:3, :3].T
            errors.append(np.r_[rotation_vector(turn), (reached[:3, 3] - at) / self.length])
        for factors, offset in self.equations:
            row = np.zeros(self.count)
            for name, factor in factors.items():
                row[self.columns[name][0]] += factor
            rows.append((row * self.unit)[None])
            errors.append([row @ values - offset])
        if not rows:
            return np.zeros((0, self.count)), np.zeros(0)
        return np.vstack(rows), np.concatenate(errors)

    def close(self, values):
        """Damped Gauss-Newton; the values reached, and the error left."""
        for _ in range(300):
            jacobian, error = self.at(values)
            size = np.linalg.norm(error)
            if size < 1e-14 or error.size == 0:
                break
            u, s, v = np.linalg.svd(jacobian, full_matrices=False)
            step = -v.T @ ((s / (s**2 + min(1.0, size**2) + 1e-30)) * (u.T @ error))
            values = values + step * min(1.0, 0.5 / max(np.abs(step).max(), 1e-300)) * self.unit
            after = np.linalg.norm(self.at(values)[1])
            if size < 1e-11 and after > 0.5 * size:
                break
        return values, np.linalg.norm(self.at(values)[1])


def rotation_vector(turn):
    u, _, v = np.linalg.svd(turn)
    turn = u @ v
    vector = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2
    sine, cosine = np.linalg.norm(vector), (np.trace(turn) - 1) / 2
    angle = math.atan2(sine, cosine)
    if sine > 1e-9:
        return vector * angle / sine
    if cosine > 0:
        return vector
    # Half a turn: the axis is the column of R + 1 that is longest.
    columns = turn + np.eye(3)
    axis = columns[:, np.argmax(np.linalg.norm(columns, axis=0))]
    return axis / np.linalg.norm(axis) * math.pi


def kernel(jacobian):
    """Dimension and an orthonormal basis; `None` where it is unclear."""
    if jacobian.shape[0] == 0 or not jacobian.any():
        return jacobian.shape[1], np.eye(jacobian.shape[1])
    _, s, v = np.linalg.svd(jacobian)
    if ((s > ZERO * s[0]) & (s < UNCLEAR * s[0])).any():
        return None, None
    rank = int((s >= UNCLEAR * s[0]).sum())
    return jacobian.shape[1] - rank, v[rank:].T


def freedoms(robot, seed=1):
    """Freedoms at the closed pose, at poses nearby, and how many equations repeat others; a free piece has six of its own."""
    equations = Equations(robot)
    random = np.random.default_rng(seed)
    values, error = equations.close(np.zeros(equations.count))
    for spread in np.linspace(0.1, 1, RESTARTS):
        if error <= 1e-9:
            break
        values, error = equations.close(spread * random.standard_normal(equations.count) * equations.unit)
    if error > 1e-9:
        return {"closed": False, "error": float(error)}
    jacobian, _ = equations.at(values)
    here, basis = kernel(jacobian)
    if here is None:
        return {"closed": True, "here": None}
    nearby = []
    for step in range(NEARBY if here and len(jacobian) else 0):
        direction = basis @ random.standard_normal(here)
        direction /= np.abs(direction).max()
        moved, error = equations.close(values + 0.05 * (1 + step) * direction * equations.unit)
        there, _ = kernel(equations.at(moved)[0])
        # A pose that went back to where it came from says nothing of those nearby.
        if error < 1e-10 and there is not None and np.abs((moved - values) / equations.unit).max() > 1e-3:
            nearby.append(there)
    redundant = jacobian.shape[0] - (equations.count - here)
    return {"closed": True, "here": here, "nearby": min(nearby, default=here), "redundant": int(redundant), "loops": len(robot.loops)}
