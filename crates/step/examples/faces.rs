//! Prints the parts of STEP files and the surfaces of their faces, in the frame of the assembly, one face a line.
//!
//! ```text
//! cargo run -p kutzbach-step --example faces -- examples/step/four_bar.step
//! ```
//!
//! Columns, parted by tabs: file, part, kind of surface, `inside` or `outside` for where the material is, a point of plane or axis, or the
//! apex or centre (m), the normal or direction, the radius (m) or half angle (rad), from where to where it goes along its direction (m). What a
//! surface does not have is zero.

use kutzbach_step::{Assembly, Side, Surface, read};
use nalgebra::Vector3;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    for file in std::env::args().skip(1) {
        let assembly = read(&std::fs::read(&file)?)?;
        print_faces(&file, &assembly);
    }
    Ok(())
}

fn print_faces(file: &str, assembly: &Assembly) {
    for part in &assembly.parts {
        for face in part.faces.iter() {
            let face = face.moved(&part.pose);
            let side = match face.material {
                Side::Inside => "inside",
                Side::Outside => "outside",
            };
            let (kind, point, direction, size) = columns(&face.surface);
            let numbers: Vec<String> = point
                .iter()
                .chain(direction.iter())
                .chain([&size, &face.extent.0, &face.extent.1])
                .map(|x| format!("{x:?}"))
                .collect();
            println!(
                "{file}\t{}\t{kind}\t{side}\t{}",
                part.name,
                numbers.join("\t")
            );
        }
    }
}

/// The kind of a surface, its point, its direction, and its radius or angle.
fn columns(surface: &Surface) -> (&str, Vector3<f64>, Vector3<f64>, f64) {
    match surface {
        Surface::Plane { point, normal } => ("plane", *point, *normal, 0.0),
        Surface::Cylinder {
            point,
            direction,
            radius,
        } => ("cylinder", *point, *direction, *radius),
        Surface::Cone {
            apex,
            direction,
            half_angle,
        } => ("cone", *apex, *direction, *half_angle),
        Surface::Sphere { centre, radius } => ("sphere", *centre, Vector3::zeros(), *radius),
        Surface::Other(keyword) => (keyword.as_str(), Vector3::zeros(), Vector3::zeros(), 0.0),
    }
}
