//! What a file says beside links and joints: couplings, the ground, poses, the scene and the expectation.

use super::WarningKind;
use super::element::{Attribute, Element};
use super::error::Outcome;
use super::names::Named;
use super::reader::{Dialect, Reader};
use super::words::{alternatives, did_you_mean, quoted};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{
    Assumption, CouplingOrigin, Expectation, HIGHEST_POWER, LinkId, Mechanism, Scene,
};
use std::str::FromStr;

/// Kinds of singular poses that an expectation can name.
const SINGULARITIES: [&str; 6] = [
    "bifurcation",
    "tangential",
    "cusp",
    "kinematotropic",
    "shaky",
    "permanently_shaky",
];

impl<'a> Reader<'a> {
    /// `<coupling name>` with `<predecessor link/>`, `<successor link/>`, `<ratio value/>` and, where it is stated, `<carrier link/>`.
    pub(super) fn read_coupling(&mut self, coupling: Element<'a>) -> Outcome<()> {
        self.uses(Dialect::UrdfPlus);
        self.other_closures = true;
        self.note_foreign_attributes(coupling, &["name", "type", "offset"])?;
        if coupling.elements().any(|part| part.name() == "term") {
            return self.read_sum(coupling);
        }
        if let Some(offset) = coupling.attribute("offset") {
            return Err(offset.fault("a coupling by a ratio of rates has no offset"));
        }
        // URDF+'s parsers (ROAM-Lab-ND/generalized_rbda, ClusterTreeParsing.cpp) read every coupling as one of rolling; the
        // word is optional.
        one_of(coupling, "type", &["rolling"])?;
        let name = self.directory.add(Named::Coupling, coupling)?;
        let parts = self.parts(
            coupling,
            &["predecessor", "successor", "ratio", "carrier"],
            &[],
            &[],
        )?;
        let (mut predecessor, mut successor, mut ratio, mut carrier) = (None, None, None, None);
        for part in parts {
            if part.name() == "ratio" {
                self.leaf(part, &["value"])?;
                ratio = Some(self.number(part.required("value")?)?);
                continue;
            }
            self.leaf(part, &["link"])?;
            let link = self.directory.refer(Named::Link, part, "link")?;
            match part.name() {
                "predecessor" => predecessor = Some(link),
                "carrier" => carrier = Some(link),
                _ => successor = Some(link),
            }
        }
        let needs =
            |what: &str| coupling.fault(format!("coupling {} needs <{what}>", quoted(name)));
        let predecessor =
            predecessor.ok_or_else(|| needs("predecessor").help("<predecessor link=\"...\"/>"))?;
        let successor =
            successor.ok_or_else(|| needs("successor").help("<successor link=\"...\"/>"))?;
        let ratio = ratio.ok_or_else(|| {
            needs("ratio").help("<ratio value=\"successor's rate per predecessor's rate\"/>")
        })?;
        if carrier.is_some() {
            self.uses(Dialect::Own);
        }
        self.builder
            .coupling_on(carrier, name, [predecessor, successor], ratio);
        Ok(())
    }

    /// `<coupling name offset><term joint coefficient power/>…</coupling>`: a sum over powers of joints.
    fn read_sum(&mut self, coupling: Element<'a>) -> Outcome<()> {
        self.uses(Dialect::Own);
        let name = self.directory.add(Named::Coupling, coupling)?;
        let offset = self.optional_number(coupling, "offset")?;
        let mut terms = Vec::new();
        for part in coupling.children()? {
            if part.name() != "term" {
                let message = format!(
                    "<{}> beside <term> has no meaning in a coupling",
                    part.name()
                );
                return Err(part
                    .fault(message)
                    .help("joints with coefficients, or two links with a ratio"));
            }
            self.leaf(part, &["joint", "coefficient", "power"])?;
            let joint = self.directory.refer(Named::Joint, part, "joint")?;
            let coefficient = self.number(part.required("coefficient")?)?;
            let power = match part.attribute("power") {
                Some(power) => power_of(power)?,
                None => 1,
            };
            terms.push((joint.to_owned(), power, coefficient));
        }
        self.builder
            .polynomial_coupling(name, terms, offset.unwrap_or_else(Number::zero));
        Ok(())
    }

    /// Warns of couplings whose carrier is taken for granted.
    pub(super) fn warn_of_assumptions(&mut self, mechanism: &Mechanism) {
        let link = |id: &LinkId| mechanism.link(*id).name.clone();
        for coupling in mechanism.couplings() {
            let CouplingOrigin::Ratio { assumed, .. } = &coupling.origin else {
                continue;
            };
            let place = self.directory.place(Named::Coupling, &coupling.name);
            let at = place.map_or(0, |place| place.start);
            let name = quoted(&coupling.name);
            for assumption in assumed {
                let message = match assumption {
                    Assumption::SeenFrom { link: from, other } => {
                        let other = other.iter().map(|other| {
                            format!(
                                ", or <carrier link=\"{}\"/> if the wheels sit on that",
                                link(other)
                            )
                        });
                        let from = link(from);
                        format!(
                            "coupling {name} names no carrier, and the rates are taken as seen from {}; write <carrier link=\"{from}\"/> if that is meant{}",
                            quoted(&from),
                            other.collect::<String>()
                        )
                    }
                    Assumption::SameDirection => format!(
                        "coupling {name} joins joints whose axes point in opposite directions, and both rates count in the same direction, whatever \
                         the axes; <carrier link=\"...\"/> says that this is meant"
                    ),
                    _ => continue,
                };
                self.warn_of(at, WarningKind::Guessed, message);
            }
        }
    }

    /// `<ground link/>`.
    pub(super) fn read_ground(&mut self, ground: Element<'a>) -> Outcome<()> {
        self.uses(Dialect::Own);
        self.leaf(ground, &["link"])?;
        let link = self.directory.refer(Named::Link, ground, "link")?;
        self.builder.ground(link);
        Ok(())
    }

    /// `<configuration name>` with `<position joint value/>`, or `start` where the joint only begins there.
    pub(super) fn read_configuration(&mut self, configuration: Element<'a>) -> Outcome<()> {
        self.uses(Dialect::Own);
        self.note_foreign_attributes(configuration, &["name"])?;
        let name = self.directory.add(Named::Configuration, configuration)?;
        let (mut positions, mut starts) = (Vec::new(), Vec::new());
        for part in self.parts(configuration, &[], &["position"], &[])? {
            self.leaf(part, &["joint", "value", "start"])?;
            let joint = self.directory.refer(Named::Joint, part, "joint")?;
            let (into, given) = match (part.attribute("value"), part.attribute("start")) {
                (_, None) => (&mut positions, part.required("value")?),
                (None, Some(start)) => (&mut starts, start),
                (Some(_), Some(start)) => {
                    return Err(start
                        .fault("a joint is held at `value` or begins at `start`, not both")
                        .help("remove one of the two"));
                }
            };
            into.push((joint.to_owned(), self.number_list(given)?));
        }
        self.builder
            .configuration_with_starts(name, positions, starts);
        Ok(())
    }

    /// `<scene>`: the effects of a simulation.
    pub(super) fn read_scene(&mut self, scene: Element<'a>) -> Outcome<()> {
        self.uses(Dialect::Own);
        self.note_foreign_attributes(scene, &[])?;
        let effects = ["gravity", "contact", "limits", "friction", "damping"];
        let mut read = Scene::default();
        for part in self.parts(scene, &effects, &["drive"], &[])? {
            match part.name() {
                "gravity" => {
                    self.leaf(part, &["xyz"])?;
                    read.gravity = Some(self.numbers(part.required("xyz")?)?);
                }
                "drive" => {
                    self.leaf(part, &["joint", "velocity", "torque"])?;
                    let joint = self.directory.refer(Named::Joint, part, "joint")?;
                    let velocity = self.number(part.required("velocity")?)?;
                    let torque = self.optional_number(part, "torque")?;
                    self.builder.drive(joint, velocity, torque);
                }
                "contact" => {
                    self.leaf(part, &["restitution"])?;
                    read.contact = true;
                    read.restitution = self.optional_number(part, "restitution")?;
                }
                effect => {
                    self.leaf(part, &[])?;
                    match effect {
                        "limits" => read.limits = true,
                        "friction" => read.friction = true,
                        _ => read.damping = true,
                    }
                }
            }
        }
        self.builder.scene(read);
        Ok(())
    }

    /// `<expect .../>`: what is known of the answer.
    pub(super) fn read_expectation(&mut self, expect: Element<'a>) -> Outcome<()> {
        self.uses(Dialect::Own);
        self.leaf(
            expect,
            &[
                "finite",
                "instantaneous",
                "redundant",
                "kutzbach",
                "pose",
                "kind",
                "locked",
                "idle",
                "branches",
                "branch_dimensions",
            ],
        )?;
        let words = |name: &str| {
            expect
                .attribute(name)
                .map(|list| list.value.split_whitespace().map(str::to_owned).collect())
        };
        let dimensions = expect.attribute("branch_dimensions").map(|list| {
            let mut dimensions = list
                .value
                .split_whitespace()
                .map(|word| whole(list, word))
                .collect::<Outcome<Vec<usize>>>()?;
            dimensions.sort_unstable();
            Ok(dimensions)
        });
        let read = Expectation {
            finite: integer(expect, "finite")?,
            instantaneous: integer(expect, "instantaneous")?,
            redundant: integer(expect, "redundant")?,
            kutzbach: integer(expect, "kutzbach")?,
            pose: one_of(expect, "pose", &["regular", "singular"])?,
            kind: one_of(expect, "kind", &SINGULARITIES)?,
            locked: words("locked"),
            idle: words("idle"),
            branches: integer(expect, "branches")?,
            branch_dimensions: dimensions.transpose()?,
        };
        self.builder.expect(read);
        Ok(())
    }
}

/// An attribute with a whole number.
fn integer<T: FromStr>(element: Element<'_>, name: &str) -> Outcome<Option<T>> {
    element
        .attribute(name)
        .map(|attribute| whole(attribute, attribute.value.trim()))
        .transpose()
}

fn whole<T: FromStr>(attribute: Attribute<'_>, word: &str) -> Outcome<T> {
    word.parse()
        .map_err(|_| attribute.fault(format!("needed a whole number, found {}", quoted(word))))
}

/// An attribute with one of these words.
fn one_of(element: Element<'_>, name: &str, words: &[&str]) -> Outcome<Option<String>> {
    let Some(attribute) = element.attribute(name) else {
        return Ok(None);
    };
    if words.contains(&attribute.value) {
        return Ok(Some(attribute.value.to_owned()));
    }
    Err(attribute
        .fault(format!(
            "needed {}, found {}",
            alternatives(words),
            quoted(attribute.value)
        ))
        .maybe_help(did_you_mean(
            attribute.value,
            words.iter().copied(),
            ("`", "`"),
        )))
}

/// The power of a joint's variable in a term.
fn power_of(attribute: Attribute<'_>) -> Outcome<u32> {
    let power = attribute.value.trim().parse().ok();
    let power = power.filter(|power| (1..=HIGHEST_POWER).contains(power));
    power.ok_or_else(|| {
        let message = format!(
            "needed a power of 1 to {HIGHEST_POWER}, found {}",
            quoted(attribute.value)
        );
        attribute.fault(message)
    })
}
