"""Packs the islands of a UV layer into the unit square: shelves of decreasing height, at the largest scale that fits."""
import numpy as np


def islands(mesh, layer, chosen):
    """Loops of each connected island of the chosen faces."""
    uv = np.empty(len(mesh.loops) * 2, np.float32)
    mesh.uv_layers[layer].data.foreach_get("uv", uv)
    uv = np.round(uv.reshape(-1, 2), 5)
    parent = list(range(len(mesh.polygons)))

    def root(i):
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    corner = {}
    for p in mesh.polygons:
        if not chosen[p.index]:
            continue
        for li in p.loop_indices:
            key = (mesh.loops[li].vertex_index, float(uv[li][0]), float(uv[li][1]))
            parent[root(p.index)] = root(corner.setdefault(key, p.index))
    groups = {}
    for p in mesh.polygons:
        if chosen[p.index]:
            groups.setdefault(root(p.index), []).extend(p.loop_indices)
    return list(groups.values())


def world_scale(ob, layer, loops_of_faces):
    """Metres per unit of uv: the square root of the ratio of world area to uv area of some faces."""
    area = uv_area = 0.0
    uv = ob.data.uv_layers[layer].data
    for p in loops_of_faces:
        area += p.area
        c = [uv[li].uv for li in p.loop_indices]
        uv_area += abs(sum(a.x * b.y - b.x * a.y for a, b in zip(c, c[1:] + c[:1]))) / 2
    return (area / uv_area) ** 0.5 if uv_area > 1e-12 else 0.0


def upright(points):
    """The points, rotated for the smallest bounding box, lying on its long side, with a corner at the origin."""
    best = None
    for a in np.radians(np.arange(0, 90, 7.5)):
        c, s = np.cos(a), np.sin(a)
        p = points @ np.array([[c, -s], [s, c]])
        size = np.ptp(p, axis=0)
        if best is None or size[0] * size[1] < best[0] - 1e-12:
            best = (size[0] * size[1], p)
    p = best[1]
    if np.ptp(p[:, 1]) > np.ptp(p[:, 0]):
        p = p @ np.array([[0.0, -1.0], [1.0, 0.0]])
    return p - p.min(0)


def shelves(sizes, margin):
    """Lower left corners of boxes in the unit square, or None if they do not fit."""
    places = np.zeros((len(sizes), 2))
    x = y = height = margin
    for i in sorted(range(len(sizes)), key=lambda k: (-sizes[k][1], -sizes[k][0], k)):
        w, h = sizes[i] + margin
        if x + w > 1:
            x, y = margin, y + height
            height = 0.0
        height = max(height, h)
        if x + w > 1 or y + height > 1:
            return None
        places[i] = x, y
        x += w
    return places


def pack(shapes, margin):
    """shapes: arrays of points in metres. Returns them, packed in the unit square, and the scale [1/m]."""
    shapes = [upright(s) for s in shapes]
    sizes = np.array([s.max(0) for s in shapes])
    low, high = 0.0, 4.0
    for _ in range(24):
        middle = (low + high) / 2
        low, high = (middle, high) if shelves(sizes * middle, margin) is not None else (low, middle)
    places = shelves(sizes * low, margin)
    return [s * low + p for s, p in zip(shapes, places)], low
