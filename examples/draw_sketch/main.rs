//! Draws a sketch: what is to be constructed, how many solutions there are, and the first four as SVG.
//!
//! `cargo run --example draw_sketch [FILE [FOLDER]]`; without a folder the pictures go to `target/draw_sketch`.

use kutzbach::constructive::picture::to_svg;
use kutzbach::constructive::words::SketchWords;
use kutzbach::format::read_sketch_file;
use std::error::Error;
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args_os().skip(1).map(PathBuf::from);
    let own = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/examples/draw_sketch/truss.xml"
    );
    let file = arguments.next().unwrap_or_else(|| own.into());
    let folder = arguments
        .next()
        .unwrap_or_else(|| "target/draw_sketch".into());
    let named = read_sketch_file(&file, &[])?;
    let words = SketchWords::of(&named);
    print!("{}", words.text());
    let Ok(construction) = words.construction() else {
        return Ok(());
    };
    std::fs::create_dir_all(&folder)?;
    for (i, solution) in construction.solutions().take(4).enumerate() {
        let path = folder.join(format!("{}_{}.svg", named.name, i + 1));
        std::fs::write(&path, to_svg(&named, &solution.shapes))?;
        println!(
            "{}: off by {:.1e}",
            path.display(),
            construction.residual(&solution)
        );
    }
    Ok(())
}
