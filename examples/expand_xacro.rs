//! Prints the plain URDF that a xacro file stands for: `expand_xacro FILE [NAME=VALUE ...]`.

use kutzbach::format::{ReadOptions, expanded_file};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let file = arguments
        .next()
        .ok_or("expand_xacro FILE [NAME=VALUE ...]")?;
    let settings = arguments
        .map(|setting| match setting.split_once('=') {
            Some((name, value)) => Ok((name.to_owned(), value.to_owned())),
            None => Err(format!("write `{setting}` as NAME=VALUE")),
        })
        .collect::<Result<_, _>>()?;
    let options = ReadOptions {
        settings,
        ..ReadOptions::default()
    };
    print!("{}", expanded_file(file, &options)?);
    Ok(())
}
