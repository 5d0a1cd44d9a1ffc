//! Rigid prisms over the faces of a surface, joined elastically: energy and Gauss-Newton step.

use std::collections::BTreeMap;

use nalgebra::{Matrix6, Vector6};

use crate::deform::Twist;
use crate::deform::primo::joint::{Joint, add, gauss_points, wrench};
use crate::deform::primo::motion::Motion;
use crate::deform::solver::{Cholesky, SolveError};
use crate::geom::{Point, Vector};
use crate::shape::Surface;

/// A pull on one prism: the prism's own point towards a target.
#[derive(Debug, Clone, Copy)]
pub struct PrismPull {
    /// Which prism.
    pub prism: usize,
    /// The point at rest.
    pub rest: Point,
    /// Its target.
    pub target: Point,
    /// Weight of the squared distance.
    pub weight: f64,
}

/// The prisms of a surface and their motions.
pub struct Prisms {
    joints: Vec<Joint>,
    /// Joint weights before stiffness.
    base_weights: Vec<f64>,
    /// The present motion of each prism.
    pub motions: Vec<Motion>,
    fixed: Vec<bool>,
    cholesky: Cholesky,
    layout: Layout,
}

/// Pair weights |e|^2 / (A_i + A_j) are clamped to this range: slivers would else lock or tear
/// (ours).
const WEIGHT_RANGE: (f64, f64) = (1e-3, 50.0);

/// Weight of the joint that ties a separate component to its nearest neighbour, beside 1 to 3 for
/// an ordinary edge.
const BRIDGE_WEIGHT: f64 = 0.1;

/// Share of the mean diagonal that is added to it: parts that nothing holds stay where they are.
const RIDGE: f64 = 1e-7;

impl Prisms {
    /// Prisms of half height `h` (fraction of L) over `surface`.
    ///
    /// # Errors
    /// [`SolveError::Setup`].
    pub fn new(surface: &Surface, h: f64) -> Result<Self, SolveError> {
        let mut joints = edge_joints(surface, h);
        joints.extend(bridges(surface, &joints));
        let layout = Layout::new(surface.triangles.len(), &joints);
        let cholesky = Cholesky::new(layout.starts.clone(), layout.rows.clone())?;
        let motions = (0..surface.triangles.len() as u32)
            .map(|f| {
                let [a, b, c] = surface.corners(f);
                Motion::rest(Point::from((a.coords + b.coords + c.coords) / 3.0))
            })
            .collect();
        Ok(Self {
            base_weights: joints.iter().map(|j| j.weight).collect(),
            fixed: vec![false; surface.triangles.len()],
            joints,
            motions,
            cholesky,
            layout,
        })
    }

    /// Sets each prism's stiffness; a joint takes the harmonic mean of its two.
    pub fn set_stiffness(&mut self, k: &[f64]) {
        for (joint, base) in self.joints.iter_mut().zip(&self.base_weights) {
            let (a, b) = (k[joint.i], k[joint.j]);
            joint.weight = base * 2.0 * a * b / (a + b);
        }
    }

    /// Sets which prisms must not move.
    pub fn set_fixed(&mut self, fixed: Vec<bool>) {
        self.fixed = fixed;
    }

    /// The elastic energy at the present motions, L^2.
    pub fn energy(&self) -> f64 {
        self.energy_at(&self.motions)
    }

    fn energy_at(&self, motions: &[Motion]) -> f64 {
        self.joints.iter().map(|j| j.energy(motions)).sum()
    }

    /// One Gauss-Newton step with backtracking on elastic energy plus pulls.
    ///
    /// # Errors
    /// [`SolveError`].
    pub fn step(&mut self, pulls: &[PrismPull]) -> Result<(), SolveError> {
        let twists = self.gauss_newton(pulls)?;
        let total = |motions: &[Motion]| self.energy_at(motions) + pull_energy(motions, pulls);
        let before = total(&self.motions);
        let mut fraction = 1.0;
        for _ in 0..8 {
            let trial: Vec<Motion> = self
                .motions
                .iter()
                .zip(&twists)
                .map(|(m, (omega, v))| m.twisted(&(omega * fraction), &(v * fraction)))
                .collect();
            if total(&trial) <= before {
                self.motions = trial;
                return Ok(());
            }
            fraction /= 2.0;
        }
        // No descent left: the present motions are a minimum to rounding.
        Ok(())
    }

    /// Solves H delta = -g.
    fn gauss_newton(&mut self, pulls: &[PrismPull]) -> Result<Vec<Twist>, SolveError> {
        let n = self.motions.len();
        let mut diagonal = vec![Matrix6::zeros(); n];
        let mut gradient = vec![Vector6::zeros(); n];
        let mut values = vec![0.0; self.layout.rows.len()];
        for joint in &self.joints {
            let blocks = joint.blocks(&self.motions);
            let [h_ii, h_jj, h_ij] = blocks.hessian;
            diagonal[joint.i] += h_ii;
            diagonal[joint.j] += h_jj;
            gradient[joint.i] += blocks.gradient[0];
            gradient[joint.j] += blocks.gradient[1];
            if !(self.fixed[joint.i] || self.fixed[joint.j]) {
                self.layout.add_pair(&mut values, joint, &h_ij);
            }
        }
        for pull in pulls {
            let m = &self.motions[pull.prism];
            let x = m.apply(&pull.rest);
            let y = x - m.center;
            add(&mut diagonal[pull.prism], pull.weight, &y, &y);
            gradient[pull.prism] += wrench(&y, &(pull.weight * (x - pull.target)));
        }
        let ridge = RIDGE * diagonal.iter().map(|d| d.trace()).sum::<f64>() / (6 * n) as f64;
        for (i, block) in diagonal.iter_mut().enumerate() {
            if self.fixed[i] {
                *block = Matrix6::identity();
                gradient[i] = Vector6::zeros();
            } else {
                *block += Matrix6::identity() * ridge.max(f64::MIN_POSITIVE);
            }
            self.layout.set_diagonal(&mut values, i, block);
        }
        let mut x: Vec<f64> = gradient.iter().flat_map(|g| (-g).data.0[0]).collect();
        if x.iter().all(|v| *v == 0.0) {
            return Ok(vec![(Vector::zeros(), Vector::zeros()); n]);
        }
        self.cholesky.factorize(&values)?;
        self.cholesky.solve(&values, &mut x)?;
        Ok(x.chunks(6)
            .map(|d| (Vector::new(d[0], d[1], d[2]), Vector::new(d[3], d[4], d[5])))
            .collect())
    }
}

fn pull_energy(motions: &[Motion], pulls: &[PrismPull]) -> f64 {
    pulls
        .iter()
        .map(|p| p.weight * (motions[p.prism].apply(&p.rest) - p.target).norm_squared())
        .sum()
}

/// A joint for each pair of faces along an edge; where more than two meet, the first with each.
fn edge_joints(surface: &Surface, h: f64) -> Vec<Joint> {
    let mut faces_of_edge: BTreeMap<(u32, u32), Vec<usize>> = BTreeMap::new();
    for (f, &[a, b, c]) in surface.triangles.iter().enumerate() {
        for (u, v) in [(a, b), (b, c), (c, a)] {
            faces_of_edge
                .entry((u.min(v), u.max(v)))
                .or_default()
                .push(f);
        }
    }
    let mut joints = Vec::new();
    for ((u, v), faces) in faces_of_edge {
        let (a, b) = (u as usize, v as usize);
        let (x_a, x_b) = (surface.positions[a], surface.positions[b]);
        let (n_a, n_b) = (surface.vertex_normals[a], surface.vertex_normals[b]);
        for &j in &faces[1..] {
            let i = faces[0];
            let areas = surface.face_areas[i] + surface.face_areas[j];
            let w = ((x_b - x_a).norm_squared() / areas.max(f64::MIN_POSITIVE))
                .clamp(WEIGHT_RANGE.0, WEIGHT_RANGE.1);
            joints.push(Joint {
                i,
                j,
                points: gauss_points(&x_a, &x_b, &n_a, &n_b, h),
                weight: w / 4.0,
            });
        }
    }
    joints
}

/// Soft joints that tie each further component to what is nearest among those before it, so that
/// loose parts (eyes, buttons, shells) ride along.
fn bridges(surface: &Surface, joints: &[Joint]) -> Vec<Joint> {
    let count = surface.triangles.len();
    let component = components(count, joints);
    let parts = component.iter().max().map_or(0, |&c| c + 1);
    if parts < 2 {
        return Vec::new();
    }
    let centers: Vec<Point> = (0..count as u32)
        .map(|f| {
            let [a, b, c] = surface.corners(f);
            Point::from((a.coords + b.coords + c.coords) / 3.0)
        })
        .collect();
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); parts];
    for (f, &c) in component.iter().enumerate() {
        members[c].push(f);
    }
    members.sort_by_key(|m| std::cmp::Reverse(m.len()));
    let mut anchored: Vec<usize> = members[0].clone();
    let mut found = Vec::new();
    for part in &members[1..] {
        let index = crate::geom::PointIndex::new(
            &anchored
                .iter()
                .map(|&f| centers[f].coords.into())
                .collect::<Vec<[f64; 3]>>(),
        );
        let mut links: Vec<(f64, usize, usize)> = part
            .iter()
            .filter_map(|&i| {
                let (k, d2) = index.nearest(&centers[i].coords.into())?;
                Some((d2, i, anchored[k as usize]))
            })
            .collect();
        links.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for &(_, i, j) in links.iter().take(BRIDGES_PER_PART) {
            found.push(bridge(surface, &centers, i, j));
        }
        anchored.extend_from_slice(part);
    }
    found
}

const BRIDGES_PER_PART: usize = 6;

fn bridge(surface: &Surface, centers: &[Point], i: usize, j: usize) -> Joint {
    let [a, b, c] = surface.corners(i as u32);
    Joint {
        i,
        j,
        points: [a, b, c, nalgebra::center(&centers[i], &centers[j])],
        weight: BRIDGE_WEIGHT / 4.0,
    }
}

/// The component of each prism, numbered by first member.
fn components(count: usize, joints: &[Joint]) -> Vec<usize> {
    let mut near: Vec<Vec<usize>> = vec![Vec::new(); count];
    for joint in joints {
        near[joint.i].push(joint.j);
        near[joint.j].push(joint.i);
    }
    let mut component = vec![usize::MAX; count];
    let mut parts = 0;
    for start in 0..count {
        if component[start] != usize::MAX {
            continue;
        }
        let mut stack = vec![start];
        component[start] = parts;
        while let Some(f) = stack.pop() {
            for &g in &near[f] {
                if component[g] == usize::MAX {
                    component[g] = parts;
                    stack.push(g);
                }
            }
        }
        parts += 1;
    }
    component
}

/// Where the 6x6 blocks lie in the compressed lower triangle.
struct Layout {
    starts: Vec<usize>,
    rows: Vec<usize>,
    /// For block column i: the block rows below the diagonal, increasing.
    below: Vec<Vec<usize>>,
}

impl Layout {
    fn new(count: usize, joints: &[Joint]) -> Self {
        let mut below = vec![Vec::new(); count];
        for joint in joints {
            below[joint.i.min(joint.j)].push(joint.i.max(joint.j));
        }
        let mut starts = vec![0];
        let mut rows = Vec::new();
        for (i, list) in below.iter_mut().enumerate() {
            list.sort_unstable();
            list.dedup();
            for c in 0..6 {
                rows.extend(6 * i + c..6 * i + 6);
                for &j in list.iter() {
                    rows.extend(6 * j..6 * j + 6);
                }
                starts.push(rows.len());
            }
        }
        Self {
            starts,
            rows,
            below,
        }
    }

    fn set_diagonal(&self, values: &mut [f64], i: usize, block: &Matrix6<f64>) {
        for c in 0..6 {
            let start = self.starts[6 * i + c];
            for r in c..6 {
                values[start + r - c] = block[(r, c)];
            }
        }
    }

    /// Adds H_ij of a joint, transposed where j comes before i.
    fn add_pair(&self, values: &mut [f64], joint: &Joint, h_ij: &Matrix6<f64>) {
        let (column, row) = (joint.i.min(joint.j), joint.i.max(joint.j));
        let Ok(slot) = self.below[column].binary_search(&row) else {
            return;
        };
        for c in 0..6 {
            let start = self.starts[6 * column + c] + (6 - c) + 6 * slot;
            for r in 0..6 {
                // H_ij has rows of i; the stored block has rows of the later prism.
                let value = if joint.i < joint.j {
                    h_ij[(c, r)]
                } else {
                    h_ij[(r, c)]
                };
                values[start + r] += value;
            }
        }
    }
}
