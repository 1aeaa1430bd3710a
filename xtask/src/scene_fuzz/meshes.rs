//! Closed meshes that face outward.

/// Points and triangles.
pub(super) type Mesh = (Vec<[f64; 3]>, Vec<[usize; 3]>);

/// A polygon, counter-clockwise, drawn out along z; `ears` are its triangles.
pub(super) fn prism(polygon: &[[f64; 2]], ears: &[[usize; 3]], [bottom, top]: [f64; 2]) -> Mesh {
    let n = polygon.len();
    let mut points: Vec<[f64; 3]> = Vec::new();
    for z in [bottom, top] {
        points.extend(polygon.iter().map(|&[x, y]| [x, y, z]));
    }
    let mut triangles = Vec::new();
    for &[a, b, c] in ears {
        triangles.push([a, c, b]);
        triangles.push([n + a, n + b, n + c]);
    }
    for a in 0..n {
        let b = (a + 1) % n;
        triangles.push([a, b, n + b]);
        triangles.push([a, n + b, n + a]);
    }
    (points, triangles)
}

pub(super) fn cuboid(min: [f64; 3], max: [f64; 3]) -> Mesh {
    let polygon = [
        [min[0], min[1]],
        [max[0], min[1]],
        [max[0], max[1]],
        [min[0], max[1]],
    ];
    prism(&polygon, &[[0, 1, 2], [0, 2, 3]], [min[2], max[2]])
}

/// An L of legs as wide as `part` of its size.
pub(super) fn angle_iron(min: [f64; 3], max: [f64; 3], part: f64) -> Mesh {
    let x = min[0] + part * (max[0] - min[0]);
    let y = min[1] + part * (max[1] - min[1]);
    let polygon = [
        [min[0], min[1]],
        [max[0], min[1]],
        [max[0], y],
        [x, y],
        [x, max[1]],
        [min[0], max[1]],
    ];
    prism(
        &polygon,
        &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]],
        [min[2], max[2]],
    )
}

pub(super) fn octahedron(center: [f64; 3], radius: f64) -> Mesh {
    let mut points = Vec::new();
    for axis in 0..3 {
        for side in [radius, -radius] {
            let mut p = center;
            p[axis] += side;
            points.push(p);
        }
    }
    let mut triangles = Vec::new();
    for x in 0..2 {
        for y in 2..4 {
            for z in 4..6 {
                let is_even = (x + (y - 2) + (z - 4)) % 2 == 0;
                triangles.push(if is_even { [x, y, z] } else { [x, z, y] });
            }
        }
    }
    (points, triangles)
}

/// An octahedron, subdivided and blown up.
pub(super) fn ball(center: [f64; 3], radius: f64, times: usize) -> Mesh {
    let (mut points, mut triangles) = octahedron([0.0; 3], 1.0);
    for _ in 0..times {
        let mut middles = std::collections::BTreeMap::new();
        let mut middle = |points: &mut Vec<[f64; 3]>, a: usize, b: usize| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                let p: [f64; 3] = std::array::from_fn(|k| points[a][k] + points[b][k]);
                let length = p.iter().map(|x| x * x).sum::<f64>().sqrt();
                points.push(p.map(|x| x / length));
                points.len() - 1
            })
        };
        triangles = triangles
            .into_iter()
            .flat_map(|[a, b, c]| {
                let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|[i, j]| middle(&mut points, i, j));
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    let points = points
        .into_iter()
        .map(|p| std::array::from_fn(|k| center[k] + radius * p[k]))
        .collect();
    (points, triangles)
}
