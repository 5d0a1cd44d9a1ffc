//! What was found, a panel each: the patch and its image in their colours, with plane, axis or arrow.

use crate::detect::Group;
use crate::geom::{Point, Vector};
use crate::job::Detected;
use crate::job::pictures::{VIEW_SIZE, color, flat, hue, views};
use crate::patch::Symmetry;
use crate::picture::{Canvas, Exhibit, Gallery, Rod, categorical};
use crate::report::faces::FaceSamples;
use crate::slip::{Continuous, Slip};
use crate::transform::{Elements, Isometry, Kind, Plane};

/// Panels of a page at the most.
const PANELS: usize = 6;
/// Half the width of an axis, fraction of L.
const THIN: f64 = 0.004;
/// How far an axis reaches beyond the shape, fraction of L.
const BEYOND: f64 = 0.06;
/// An axis is drawn where its point nearest to the patch is no further from the shape's centroid than
/// this many of the shape's radii.
const FAR: f64 = 1.3;
/// How much of an image's colour is white; what is patch and image has half of it.
const TINT: f64 = 0.6;

/// What was `found`, in panels: groups first, then continuous symmetries, then single ones, those of
/// most of the surface first. Where nothing was, views of the shape.
pub fn symmetries(found: &Detected, title: &str) -> Canvas {
    if let Some(page) = flat::found(found, title) {
        return page;
    }
    let show = Show {
        found,
        faces: FaceSamples::of(found),
    };
    let exhibits = show.exhibits();
    if exhibits.is_empty() {
        return views(found, title);
    }
    let surface = &found.working.surface;
    let gallery = Gallery {
        title,
        positions: &surface.positions,
        triangles: &surface.triangles,
        upright: show.upright(),
        exhibits: &exhibits,
        size: VIEW_SIZE,
    };
    gallery.canvas()
}

struct Show<'a> {
    found: &'a Detected,
    faces: FaceSamples,
}

impl Show<'_> {
    fn exhibits(&self) -> Vec<Exhibit> {
        let found = &self.found.detection;
        let groups = (0..).zip(&found.groups).map(|(k, g)| self.group(k, g));
        let slides = (0..).zip(&found.continuous).map(|(k, c)| self.slide(k, c));
        let alone = |s: &&Symmetry| self.found.group_of(s.id).is_none();
        let mut single: Vec<&Symmetry> = found.symmetries.iter().filter(alone).collect();
        single.sort_by(|a, b| b.area_fraction.total_cmp(&a.area_fraction));
        let single = single.into_iter().map(|s| self.symmetry(s));
        groups.chain(slides).chain(single).take(PANELS).collect()
    }

    /// The mirror of most of the surface.
    fn upright(&self) -> Option<Plane> {
        let symmetries = self.found.symmetries().iter();
        let mirrors = symmetries.filter(|s| self.found.elements(s).kind == Kind::Mirror);
        let largest = mirrors.max_by(|a, b| a.area_fraction.total_cmp(&b.area_fraction));
        largest.map(Symmetry::plane)
    }

    fn symmetry(&self, symmetry: &Symmetry) -> Exhibit {
        let elements = self.found.elements(symmetry);
        let color = color(symmetry.id);
        let mut exhibit = self.drawn(&elements, color);
        exhibit.caption = format!("{}: {}", symmetry.id, named(&elements));
        exhibit.note = share(symmetry.area_fraction);
        let shifts = matches!(
            elements.kind,
            Kind::Translation | Kind::Glide | Kind::Inversion
        );
        if shifts || self.is_far(&elements) {
            let from = self.middle(symmetry);
            let to = elements.isometry().apply(&from);
            exhibit.rods.push(arrow(from, to, color));
        }
        let samples = self.found.detection.samples.list.len();
        let [patch, image] = self.faces.patch(symmetry, samples);
        let is_patch = |f: &&u32| patch.binary_search(f).is_ok();
        let both = image.iter().filter(is_patch).copied().collect();
        exhibit.parts = vec![
            (patch.clone(), color),
            (image, tint(color, TINT)),
            (both, tint(color, TINT / 2.0)),
        ];
        exhibit
    }

    /// The copies of a group each in a colour of its own; where copies are not apart, all that its
    /// symmetries hold for.
    fn group(&self, number: u32, group: &Group) -> Exhibit {
        let found = self.found;
        let members = || {
            let all = found.symmetries().iter();
            all.filter(|s| group.symmetries.contains(&s.id))
        };
        let mut exhibit = Exhibit::empty();
        let color = color(number);
        if let Some(axis) = group.axis {
            exhibit.rods.push(self.axis(&group.point, &axis, color));
        }
        let mirrors = group.elements.iter().filter_map(Isometry::as_mirror);
        exhibit.planes = mirrors.take(PLANES).map(|p| (p, color)).collect();
        if let Some(step) = &group.step {
            let to = step.apply(&group.point);
            exhibit.rods.push(arrow(group.point, to, color));
        }
        exhibit.parts = match group.orbit.is_empty() {
            false => self.copies(&group.orbit),
            true => {
                let count = found.detection.samples.list.len();
                let both = members().flat_map(|s| self.faces.patch(s, count));
                vec![(both.flatten().collect(), color)]
            }
        };
        exhibit.caption = match group.orbit.len() {
            0 => format!("{}, order {}", group.name, group.order),
            _ => group.name.clone(),
        };
        exhibit.note = format!(
            "{} symmetries; {}",
            group.symmetries.len(),
            share(self.faces.area(&exhibit.parts))
        );
        exhibit
    }

    fn copies(&self, orbit: &[Vec<u32>]) -> Vec<(Vec<u32>, [u8; 3])> {
        let copies = (0..).zip(orbit);
        copies
            .map(|(k, samples)| (self.faces.of_samples(samples), categorical(hue(k))))
            .collect()
    }

    fn slide(&self, number: u32, slide: &Continuous) -> Exhibit {
        let color = color(number);
        let mut exhibit = Exhibit::empty();
        let part = self.faces.of_samples(&slide.samples);
        exhibit.parts = vec![(part, tint(color, TINT / 2.0))];
        let rod = slide.axis.map(|axis| self.axis(&slide.point, &axis, color));
        exhibit.rods.extend(rod);
        let caption = match slide.slip {
            Slip::Revolution => "revolution: any angle",
            Slip::Extrusion => "extrusion: any shift",
            Slip::Helix => "helix: any angle, with a shift",
            Slip::Cylinder => "cylinder: any angle and shift",
            Slip::Sphere => "sphere: any turn",
            Slip::Plane => "plane: any shift and turn",
        };
        exhibit.caption = caption.into();
        exhibit.note = share(slide.area_fraction);
        exhibit
    }

    /// Planes and axes of an isometry.
    fn drawn(&self, elements: &Elements, color: [u8; 3]) -> Exhibit {
        let mut exhibit = Exhibit::empty();
        let Some(axis) = elements.axis.filter(|_| !self.is_far(elements)) else {
            return exhibit;
        };
        let through = (Plane::through(&elements.point, axis), color);
        let mut rod = self.axis(&elements.point, &axis, color);
        match elements.kind {
            Kind::Mirror | Kind::Glide => exhibit.planes.push(through),
            Kind::Rotation => exhibit.rods.push(rod),
            Kind::Screw => {
                if elements.shift.dot(&axis) < 0.0 {
                    (rod.from, rod.to) = (rod.to, rod.from);
                }
                exhibit.rods.push(Rod { arrow: true, ..rod });
            }
            Kind::Rotoreflection => {
                exhibit.rods.push(rod);
                exhibit.planes.push(through);
            }
            Kind::Identity | Kind::Translation | Kind::Inversion => {}
        }
        exhibit
    }

    /// Whether an axis or fixed point lies so far from the shape that a picture of both shows neither.
    fn is_far(&self, elements: &Elements) -> bool {
        let positions = self.found.working.surface.positions.iter();
        let reach = positions.map(|p| p.coords.norm()).fold(0.0, f64::max);
        elements.point.coords.norm() > FAR * reach
    }

    /// The axis through `point`, along the shape and a little beyond.
    fn axis(&self, point: &Point, axis: &Vector, color: [u8; 3]) -> Rod {
        let along = |p: &Point| axis.dot(&(p - point));
        let heights = self.found.working.surface.positions.iter().map(along);
        let (low, high) = heights.fold((0.0_f64, 0.0_f64), |(l, h), x| (l.min(x), h.max(x)));
        Rod {
            from: point + axis * (low - BEYOND),
            to: point + axis * (high + BEYOND),
            radius: THIN,
            arrow: false,
            color: dark(color),
        }
    }

    /// The middle of a symmetry's patch.
    fn middle(&self, symmetry: &Symmetry) -> Point {
        let samples = &self.found.detection.samples.list;
        let places = symmetry.pairs.iter();
        let sum: Vector = places
            .map(|p| samples[p.sample as usize].position.coords)
            .sum();
        Point::from(sum / symmetry.pairs.len().max(1) as f64)
    }
}

/// Planes of a group that are drawn at the most.
const PLANES: usize = 6;

fn arrow(from: Point, to: Point, color: [u8; 3]) -> Rod {
    Rod {
        from,
        to,
        radius: 1.5 * THIN,
        arrow: true,
        color: dark(color),
    }
}

/// The kind with its angle, order and shift.
fn named(elements: &Elements) -> String {
    let kind = elements.kind;
    let mut by = Vec::new();
    if matches!(kind, Kind::Rotation | Kind::Screw | Kind::Rotoreflection) {
        by.push(format!("{:.1}°", elements.angle.to_degrees().abs()));
    }
    if matches!(kind, Kind::Translation | Kind::Screw | Kind::Glide) {
        by.push(format!("{:.1} % of L", 100.0 * elements.shift.norm()));
    }
    let mut text = kind.name().to_owned();
    if !by.is_empty() {
        text += &format!(" by {}", by.join(" and "));
    }
    match elements.order {
        Some(order) => format!("{text}, order {order}"),
        None => text,
    }
}

/// The colour of lines upon parts of `color`.
fn dark(color: [u8; 3]) -> [u8; 3] {
    color.map(|c| c / 2)
}

fn share(area: f64) -> String {
    format!("{:.0} % of the surface", 100.0 * area)
}

/// The colour with a share of white.
fn tint(color: [u8; 3], white: f64) -> [u8; 3] {
    color.map(|c| (f64::from(c) * (1.0 - white) + 255.0 * white).round() as u8)
}
