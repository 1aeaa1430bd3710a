//! Face, edge and vertex normals, and which edges are sharp.

use sphpack_neighbors::point;

use super::{EDGE_DEGREES, triangle};

/// Normals of a mesh, by triangle.
#[derive(Debug, Clone)]
pub(super) struct Normals {
    /// Unit normals; zero for a triangle without area.
    pub(super) face: Vec<[f64; 3]>,
    /// Per side: the mean of its two faces' normals, a unit vector.
    pub(super) side: Vec<[[f64; 3]; 3]>,
    /// Per vertex: the mean of its faces' normals weighted by their angles there, a unit vector.
    pub(super) vertex: Vec<[f64; 3]>,
    /// Per corner: the same over the faces that can be reached without crossing a sharp edge, so that normals turn
    /// smoothly over smooth parts and not across sharp edges.
    pub(super) corner: Vec<[[f64; 3]; 3]>,
    /// Per triangle, bit `k`: side `k` is sharp.
    pub(super) sharp: Vec<u8>,
    /// Per triangle and side: the angle by which the surface turns there, radians; positive where convex.
    pub(super) turn: Vec<[f64; 3]>,
    /// Per vertex: whether it is a corner of the body.
    pub(super) is_corner: Vec<bool>,
    /// Per vertex: whether a sharp edge passes or ends there.
    pub(super) on_edge: Vec<bool>,
}

impl Normals {
    pub(super) fn new(
        vertices: usize,
        triangles: &[[u32; 3]],
        corners: &[[[f64; 3]; 3]],
        across: &[[(u32, u8); 3]],
    ) -> Self {
        let face: Vec<[f64; 3]> = corners
            .iter()
            .map(|t| point::unit(triangle::area_vector(t)).unwrap_or([0.0; 3]))
            .collect();
        let angles: Vec<[f64; 3]> = corners
            .iter()
            .map(|t| std::array::from_fn(|k| triangle::angle(t, k)))
            .collect();
        let limit = EDGE_DEGREES.to_radians();
        let mut side = Vec::with_capacity(triangles.len());
        let mut sharp = Vec::with_capacity(triangles.len());
        let mut turn = Vec::with_capacity(triangles.len());
        let mut vertex = vec![[0.0; 3]; vertices];
        for (t, &[a, b, c]) in triangles.iter().enumerate() {
            let mine = face[t];
            let (mut sides, mut bits, mut turns) = ([[0.0; 3]; 3], 0, [0.0; 3]);
            for k in 0..3 {
                let other = face[across[t][k].0 as usize];
                let along = point::sub(corners[t][(k + 1) % 3], corners[t][k]);
                sides[k] = point::unit(point::add(mine, other)).unwrap_or(mine);
                let sin = point::cross(mine, other);
                let angle = point::norm(sin).atan2(point::dot(mine, other));
                // A face without area says nothing about sharpness.
                if point::norm_squared(mine) > 0.0 && point::norm_squared(other) > 0.0 {
                    turns[k] = angle.copysign(point::dot(sin, along));
                    bits |= u8::from(angle > limit) << k;
                }
            }
            side.push(sides);
            sharp.push(bits);
            turn.push(turns);
            for (k, v) in [a, b, c].into_iter().enumerate() {
                let sum = &mut vertex[v as usize];
                *sum = point::add_scaled(*sum, angles[t][k], mine);
            }
        }
        for n in &mut vertex {
            *n = point::unit(*n).unwrap_or(*n);
        }
        let corner = (0..triangles.len())
            .map(|t| std::array::from_fn(|k| smooth_normal(t, k, &face, &angles, &sharp, across)))
            .collect();
        let mut on_edge = vec![false; vertices];
        for (t, indices) in triangles.iter().enumerate() {
            for k in (0..3).filter(|k| sharp[t] >> k & 1 == 1) {
                on_edge[indices[k] as usize] = true;
                on_edge[indices[(k + 1) % 3] as usize] = true;
            }
        }
        let is_corner = corners_of_body(triangles, corners, &face, &vertex, &sharp);
        Self {
            face,
            side,
            vertex,
            corner,
            sharp,
            turn,
            is_corner,
            on_edge,
        }
    }
}

/// The angle-weighted mean over the faces around corner `k` of triangle `t`, up to the sharp edges on both sides.
fn smooth_normal(
    t: usize,
    k: usize,
    face: &[[f64; 3]],
    angles: &[[f64; 3]],
    sharp: &[u8],
    across: &[[(u32, u8); 3]],
) -> [f64; 3] {
    let mut sum = point::scale(face[t], angles[t][k]);
    // Once around over the side that leaves the corner, then, if a sharp edge stopped that, over the one that
    // arrives.
    for leaving in [true, false] {
        let (mut at, mut corner) = (t, k);
        // No vertex has more faces than the mesh.
        for _ in 0..face.len() {
            let side = if leaving { corner } else { (corner + 2) % 3 };
            if sharp[at] >> side & 1 == 1 {
                break;
            }
            let (next, back) = across[at][side];
            let back = back as usize;
            // The neighbour runs along the side the other way.
            corner = if leaving { (back + 1) % 3 } else { back };
            at = next as usize;
            if at == t {
                return point::unit(sum).unwrap_or(face[t]);
            }
            sum = point::add_scaled(sum, angles[at][corner], face[at]);
        }
    }
    point::unit(sum).unwrap_or(face[t])
}

/// Vertices where sharp edges end, branch or turn sharply, and the tips of cones, where faces lean away from the
/// mean normal by more than the limit without any edge being sharp.
fn corners_of_body(
    triangles: &[[u32; 3]],
    corners: &[[[f64; 3]; 3]],
    face: &[[f64; 3]],
    vertex: &[[f64; 3]],
    sharp: &[u8],
) -> Vec<bool> {
    let limit = EDGE_DEGREES.to_radians().cos();
    let mut count = vec![0_u32; vertex.len()];
    let mut first = vec![[0.0; 3]; vertex.len()];
    let mut turns = vec![false; vertex.len()];
    let mut leans = vec![false; vertex.len()];
    for (t, indices) in triangles.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (indices[k] as usize, indices[(k + 1) % 3] as usize);
            leans[a] |=
                point::norm_squared(face[t]) > 0.0 && point::dot(face[t], vertex[a]) < limit;
            // Each edge once: from the triangle where it runs upward.
            if sharp[t] >> k & 1 == 0 || a > b {
                continue;
            }
            let along = point::sub(corners[t][(k + 1) % 3], corners[t][k]);
            let along = point::unit(along).unwrap_or([0.0; 3]);
            for (v, away) in [(a, along), (b, point::scale(along, -1.0))] {
                count[v] += 1;
                if count[v] == 1 {
                    first[v] = away;
                } else {
                    turns[v] = -point::dot(first[v], away) < limit;
                }
            }
        }
    }
    (0..vertex.len())
        .map(|v| match count[v] {
            0 => leans[v],
            2 => turns[v],
            _ => true,
        })
        .collect()
}
