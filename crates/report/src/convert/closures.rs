//! What closes loops in MJCF.
//!
//! A ball is one `<connect>`, a hinge two, a fixed joint a `<weld>`. Other kinds have no equality of their own: a body hangs at the
//! predecessor by the freedoms of the joint and is welded to the successor. MuJoCo closes `<connect>` and `<weld>` by bodies as they are
//! drawn; where a loop is not closed as drawn, sites say where the two sides have to meet.

use super::Hinges;
use super::gaps::{gap, is_spoken_of, lever, tolerance};
use super::mjcf::Mjcf;
use super::parts::{Part, parts};
use super::place::{Place, Triple, is_identity, rounded, settled, texts, triple, values};
use kutzbach_closure::Rigid;
use kutzbach_format::escaped;
use kutzbach_model::mechanism::{Frame, Joint, JointId, JointKind, LinkId, Side};

/// A body that carries the freedoms of a joint.
#[derive(Clone, Debug)]
pub(super) struct Carrier {
    pub(super) name: String,
    pub(super) joint: JointId,
    pub(super) place: Place,
    pub(super) parts: Vec<Part>,
    pub(super) names: Vec<String>,
    /// A site at its origin.
    pub(super) site: Option<String>,
}

impl Mjcf<'_> {
    /// Prepares what closes all loops.
    pub(super) fn closures(&mut self) {
        let mechanism = self.mechanism;
        let closing = mechanism.joints().iter().enumerate();
        for (index, joint) in closing.filter(|(_, joint)| joint.closes_loop) {
            self.close(JointId(index), joint);
        }
    }

    fn close(&mut self, id: JointId, joint: &Joint) {
        let geometry = self.geometry;
        let fitted = geometry.displacements[id.0].displacement(&geometry.states[id.0]);
        let gap = gap(self.mechanism, geometry, id, &fitted);
        let open = gap > tolerance(geometry, self.size);
        if open {
            self.not_said.push(format!(
                "loop `{}` is open as drawn, by {gap:.3e} m or rad: MuJoCo pulls it together when it starts",
                joint.name
            ));
        }
        let carried = is_spoken_of(self.mechanism, id);
        match joint.kind {
            JointKind::Fixed => self.weld_links(joint, open),
            JointKind::Spherical if !carried => {
                self.connect(id, joint, &[[0.0; 3]], open);
            }
            JointKind::Revolute if !carried && self.hinges == Hinges::TwoPoints => {
                self.hinge(id, joint, open);
            }
            _ => self.carry(id, joint, fitted, open),
        }
    }

    fn weld_links(&mut self, joint: &Joint, open: bool) {
        let name = escaped(&joint.name).into_owned();
        let sides = [&joint.predecessor, &joint.successor];
        if open {
            let [one, other] = sides.map(|side| self.site(side.link, &side.frame, &joint.name));
            self.equalities.push(format!(
                "<weld name=\"{name}\" site1=\"{one}\" site2=\"{other}\"/>"
            ));
        } else {
            let [one, other] = sides.map(|side| self.body_name(side.link));
            self.equalities.push(format!(
                "<weld name=\"{name}\" body1=\"{one}\" body2=\"{other}\"/>"
            ));
        }
    }

    /// Two points of the axis.
    fn hinge(&mut self, id: JointId, joint: &Joint, open: bool) {
        let axis = values(&joint.axis.0);
        let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
        let factor = lever(self.size, length);
        let end: Triple = joint.axis.0.each_ref().map(|x| x * &factor);
        self.connect(id, joint, &[[0.0; 3], values(&end)], open);
    }

    /// One `<connect>` for each point, told in the joint's frame, which both sides share at these points.
    fn connect(&mut self, id: JointId, joint: &Joint, points: &[[f64; 3]], open: bool) {
        for (index, &offset) in points.iter().enumerate() {
            let name = match index {
                0 => escaped(&joint.name).into_owned(),
                _ => {
                    let name = self.unused(&format!("{}.2", joint.name));
                    escaped(&name).into_owned()
                }
            };
            let sides = [&joint.predecessor, &joint.successor];
            if open {
                let frames = [0usize, 1].map(|side| self.in_link(id, side, sides[side], offset));
                let [one, other] =
                    [0usize, 1].map(|side| self.site(sides[side].link, &frames[side], &joint.name));
                self.equalities.push(format!(
                    "<connect name=\"{name}\" site1=\"{one}\" site2=\"{other}\"/>"
                ));
                continue;
            }
            let anchor = texts(&self.in_link(id, 0, sides[0], offset).position);
            let [one, other] = sides.map(|side| self.body_name(side.link));
            self.equalities.push(format!(
                "<connect name=\"{name}\" body1=\"{one}\" body2=\"{other}\" anchor=\"{anchor}\"/>"
            ));
        }
    }

    /// A point of the joint's frame as a point of a link; the frame's origin as the file has it.
    fn in_link(&self, id: JointId, side: usize, of: &Side, offset: [f64; 3]) -> Frame {
        let origin = &of.frame.position;
        if offset == [0.0; 3] {
            return Frame::at(origin.clone());
        }
        let turned = triple(self.geometry.sides[id.0][side].rotate(&offset));
        let sum = |i: usize| match turned[i].is_zero() {
            true => origin[i].clone(),
            false => rounded(origin[i].value() + turned[i].value()),
        };
        Frame::at([sum(0), sum(1), sum(2)])
    }

    /// A site in a link; its name.
    fn site(&mut self, link: LinkId, frame: &Frame, of: &str) -> String {
        let name = self.unused(&format!("{of}.site"));
        let name = escaped(&name).into_owned();
        let place = Place::Stated(frame.clone()).attributes();
        let site = format!("<site name=\"{name}\"{place}/>");
        self.sites.entry(link).or_default().push(site);
        name
    }

    /// A body at the predecessor that carries the freedoms and is welded to the successor.
    fn carry(&mut self, id: JointId, joint: &Joint, fitted: Rigid<f64>, open: bool) {
        let geometry = self.geometry;
        let displacement = &geometry.displacements[id.0];
        let standing = match open {
            // Where all its variables are zero.
            true => displacement.displacement(&displacement.home()),
            false => fitted,
        };
        let standing = (!is_identity(&standing)).then_some(standing);
        let place = match &standing {
            None => Place::Stated(joint.predecessor.frame.clone()),
            Some(standing) => Place::Computed(geometry.sides[id.0][0].compose(standing)),
        };
        if !open && joint.freedom() == 1 {
            let value = geometry.states[id.0].values.first();
            self.drawn[id.0] = value.map_or(0.0, |value| settled(*value));
        }
        let parts = parts(joint, standing.as_ref());
        let names = self.named(id, joint, &parts);
        let name = self.unused_body(&format!("{}_carrier", joint.name));
        let weld = escaped(&self.unused(&format!("{}.weld", joint.name))).into_owned();
        let successor = &joint.successor;
        let mut carrier = Carrier {
            name: escaped(&name).into_owned(),
            joint: id,
            place,
            parts,
            names,
            site: None,
        };
        let equality = if open {
            let own = escaped(&self.unused(&format!("{}.site", joint.name))).into_owned();
            let there = self.site(successor.link, &successor.frame, &joint.name);
            carrier.site = Some(own.clone());
            format!("<weld name=\"{weld}\" site1=\"{there}\" site2=\"{own}\"/>")
        } else {
            let there = self.body_name(successor.link);
            let own = &carrier.name;
            format!("<weld name=\"{weld}\" body1=\"{there}\" body2=\"{own}\"/>")
        };
        self.equalities.push(equality);
        self.carriers
            .entry(joint.predecessor.link)
            .or_default()
            .push(carrier);
    }
}
