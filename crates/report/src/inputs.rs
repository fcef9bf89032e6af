//! Useful and idle freedoms, and what the inputs of a mechanism do.

use super::asked::ReportError;
use super::definitions::closest;
use super::schema::{DependentInput, Follower, Freedoms, InputSource, Inputs, Limb, Report};
use kutzbach_mobility::{Actuation, Analysis, Branch, Freedom, limbs};
use kutzbach_model::mechanism::{Mechanism, Placement};
use kutzbach_motion::{Motion, inputs};

/// Names of a root link that stands for the surroundings, not for a body of the machine.
const SURROUNDINGS: [&str; 5] = ["world", "map", "odom", "ground", "universe"];

/// Tells useful freedoms from idle ones; `None` where the finite mobility or its branches are not known.
pub(super) fn freedoms(mechanism: &Mechanism, analysis: &Analysis) -> Option<Freedoms> {
    let finite = analysis.mobility.finite()?;
    let branches = analysis.branches.as_ref()?;
    let idle_of = |branch: &Branch| -> usize { branch.idle.iter().map(|idle| idle.freedom).sum() };
    let mut largest = branches.iter().filter(|branch| branch.dimension == finite);
    let first = largest.next();
    if first.is_none() && finite > 0 {
        return None;
    }
    let idle = first.map_or(0, idle_of);
    if largest.any(|other| idle_of(other) != idle) {
        return None;
    }
    let floating = 6 * analysis.structure.loose_pieces;
    Some(Freedoms {
        useful: finite.checked_sub(idle + floating)?,
        floating,
        idle,
        rods: idle > 0 && first.is_some_and(|branch| branch.idle.iter().all(|idle| idle.rod)),
        base: floating_base(mechanism),
    })
}

/// The ground's name, where it is held by convention only: the root of the file, and a body with a mass.
fn floating_base(mechanism: &Mechanism) -> Option<String> {
    let ground = mechanism.link(mechanism.ground());
    let name = ground.name.to_lowercase();
    if ground.placement != Placement::World || SURROUNDINGS.contains(&name.as_str()) {
        return None;
    }
    // Its mass may be stated in a link fixed to it.
    let fixed = mechanism
        .joints()
        .iter()
        .filter(|joint| joint.freedom() == 0 && joint.predecessor.link == mechanism.ground());
    let links = fixed
        .map(|joint| joint.successor.link)
        .chain([mechanism.ground()]);
    let mut masses = links.filter_map(|link| mechanism.link(link).inertial.as_ref());
    masses
        .any(|inertial| inertial.mass.value() > 0.0)
        .then(|| ground.name.clone())
}

/// The freedoms that names stand for: all of a joint's, or one such as `slider.trans`; each once.
///
/// # Errors
/// [`ReportError::UnknownInput`] for a name that no freedom has.
pub(super) fn asked(mechanism: &Mechanism, names: &[String]) -> Result<Vec<Freedom>, ReportError> {
    let mut found: Vec<Freedom> = Vec::new();
    for name in names {
        let matching: Vec<Freedom> = all_freedoms(mechanism)
            .filter(|freedom| {
                let joint = &mechanism.joints()[freedom.joint];
                joint.name == *name || joint.freedom_name(freedom.variable) == *name
            })
            .collect();
        if matching.is_empty() {
            let joints = mechanism.joints().iter();
            let movable = joints.filter(|joint| joint.freedom() > 0);
            return Err(ReportError::UnknownInput {
                name: name.clone(),
                mechanism: mechanism.name().to_owned(),
                fixed: mechanism.joint_named(name).is_some(),
                nearest: closest(name, movable.map(|joint| joint.name.as_str())).map(str::to_owned),
            });
        }
        for freedom in matching {
            if !found.contains(&freedom) {
                found.push(freedom);
            }
        }
    }
    Ok(found)
}

fn all_freedoms(mechanism: &Mechanism) -> impl Iterator<Item = Freedom> {
    mechanism
        .joints()
        .iter()
        .enumerate()
        .flat_map(|(joint, it)| (0..it.freedom()).map(move |variable| Freedom { joint, variable }))
}

/// Fills in what inputs do, where there is motion whose branch is known; the motion along the first branch, where it was followed.
pub(super) fn lay_over(
    report: &mut Report,
    mechanism: &Mechanism,
    analysis: &Analysis,
    configuration: &str,
    asked: Vec<Freedom>,
) -> Option<Motion> {
    let branch = analysis.branches.as_ref()?.first()?;
    let named = mechanism
        .configuration(configuration)
        .map(|_| configuration);
    let found = inputs(mechanism, analysis, branch, named, asked);
    let (given, source) = (found.given.clone(), found.source.map(InputSource::from));
    let actuation = found.actuation.clone();
    let motion = found.motion(mechanism, analysis, branch, named);
    let found = actuation;
    let name = |freedom: &Freedom| mechanism.joints()[freedom.joint].freedom_name(freedom.variable);
    let names = |freedoms: &[Freedom]| freedoms.iter().map(name).collect::<Vec<_>>();
    let link = |index: usize| mechanism.links()[index].name.clone();
    let limbs = limbs(mechanism, &analysis.geometry, &analysis.structure, branch);
    report.inputs = Some(Inputs {
        given: names(&given),
        source,
        independent: found.as_ref().map(|found| found.independent.len()),
        independent_here: found.as_ref().and_then(|found| found.independent_here),
        dependent: found.as_ref().map_or_else(Vec::new, |found| {
            let rows = found.dependent.iter().map(|dependent| DependentInput {
                input: name(&dependent.input),
                on: dependent.on.as_deref().map(names),
            });
            rows.collect()
        }),
        left: found.as_ref().map(|found| found.left),
        proposed: found
            .as_ref()
            .map_or_else(Vec::new, |found| names(&found.proposed)),
        together_here: found.as_ref().and_then(|found| found.together_here),
        complete: found.as_ref().is_some_and(|found| found.complete),
        followers: found
            .as_ref()
            .map_or_else(Vec::new, |found| followers(mechanism, found)),
        base: limbs.as_ref().map(|limbs| link(limbs.base)),
        trunk: limbs.as_ref().map(|limbs| limbs.trunk),
        limbs: limbs.map_or_else(Vec::new, |limbs| {
            let rows = limbs.limbs.iter().map(|limb| Limb {
                end: link(limb.end),
                branches: limb.branches,
                freedom: limb.freedom,
                idle: limb.idle,
            });
            rows.collect()
        }),
    });
    motion
}

fn followers(mechanism: &Mechanism, found: &Actuation) -> Vec<Follower> {
    let name = |freedom: &Freedom| mechanism.joints()[freedom.joint].freedom_name(freedom.variable);
    let mut rows: Vec<Follower> = found
        .followers
        .iter()
        .map(|follower| Follower {
            joint: name(&follower.freedom),
            of: follower.of.as_ref().map(|of| of.iter().map(name).collect()),
        })
        .collect();
    rows.sort_by(|a, b| super::natural::natural_order(&a.joint, &b.joint));
    rows
}
