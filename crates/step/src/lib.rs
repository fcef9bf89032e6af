//! STEP assemblies (ISO 10303-21; AP203, AP214, AP242): from a file to parts with their faces, and from faces that touch to
//! joints.
//!
//! - [`read`]: the parts of an assembly, each at its place, with the planes, cylinders, cones and spheres of their faces in
//!   metres. Errors name the line and the number of the entity.
//! - [`contacts()`]: the pairs of parts whose faces touch within a clearance, each with its contacts.
//! - [`joint_of`]: the displacements that the contacts of a pair leave, as one class of displacement subgroup: a pin in a hole with
//!   a shoulder is a revolute joint, not a cylindrical one and a planar one.
//!
//! # What is taken as what
//! A product is one rigid part, however many solids it has. Kinematic pairs of AP242 and AP214 are read where both links are parts
//! ([`Assembly::pairs`]). Tolerances, colours and tessellated shapes are not; what is left out and could touch or join another part is said in
//! [`Assembly::notes`].

mod assemble;
pub mod contacts;
mod curves;
mod digits;
mod error;
mod faces;
mod kinematics;
mod measure;
mod merge;
mod part21;
mod placement;
mod products;
mod quadrics;
mod representations;
mod shape;
mod spline;
mod surfaces;
#[cfg(test)]
mod tests;
mod units;

pub use contacts::{
    Contact, ContactKind, ContactOptions, Joint, JointError, PairOfParts, contacts, joint_of,
};
pub use error::{Problem, StepError};
pub use shape::{
    Assembly, EdgeCurve, Face, FaceEdge, KinematicPair, Note, NoteKind, PairMotion, Part, Side,
    Surface,
};

/// Reads a STEP file.
///
/// # Errors
/// [`StepError`], with line and entity: a text that does not follow ISO 10303-21, references to entities that are not there,
/// assemblies that contain themselves, occurrences without a place, scaled or mirrored parts, a file without faces.
pub fn read(text: &[u8]) -> Result<Assembly, StepError> {
    let file = part21::parse(text)?;
    assemble::assembly(&file)
}
