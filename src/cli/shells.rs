//! `kutzbach completions SHELL` and `kutzbach man`: the command line as shells and manuals want it told.

use super::failure::Failure;
use super::{DONE, output};
use clap::{Args, Command};
use clap_complete::Shell;

/// Print a script that completes commands, options and their values in a shell
#[derive(Debug, Args)]
#[command(
    after_help = "bash: `kutzbach completions bash > ~/.local/share/bash-completion/completions/kutzbach`\n\
    zsh: `kutzbach completions zsh > _kutzbach` in a folder of $fpath\n\
    fish: `kutzbach completions fish > ~/.config/fish/completions/kutzbach.fish`"
)]
pub struct Completions {
    /// The shell
    shell: Shell,
    #[command(flatten)]
    destination: output::Destination,
}

/// Print the manual page of the program, or of one of its commands
#[derive(Debug, Args)]
#[command(
    after_help = "`kutzbach man report | man -l -` shows it; `kutzbach man -o ~/.local/share/man/man1/kutzbach.1` keeps it."
)]
pub struct Manual {
    /// The command, such as `report`; the whole program if not given
    command: Option<String>,
    #[command(flatten)]
    destination: output::Destination,
}

/// Prints the script.
///
/// # Errors
/// Where the output cannot be written.
pub fn completions(arguments: &Completions, mut program: Command) -> Result<u8, Failure> {
    let mut script = Vec::new();
    let name = program.get_name().to_owned();
    clap_complete::generate(arguments.shell, &mut program, name, &mut script);
    put(&script, &arguments.destination)
}

/// Prints the page.
///
/// # Errors
/// Where there is no such command, or the output cannot be written.
pub fn manual(arguments: &Manual, mut program: Command) -> Result<u8, Failure> {
    // Names of commands are completed with that of the program.
    program.build();
    let described = match &arguments.command {
        None => program,
        Some(name) => program
            .find_subcommand(name)
            .cloned()
            .ok_or_else(|| Failure::Plain {
                message: format!("there is no command `{name}`"),
                help: Some("`kutzbach --help` lists them".to_owned()),
            })?,
    };
    let mut page = Vec::new();
    clap_mangen::Man::new(described)
        .render(&mut page)
        .map_err(|error| Failure::Plain {
            message: format!("cannot write the manual page: {error}"),
            help: None,
        })?;
    put(&page, &arguments.destination)
}

fn put(text: &[u8], destination: &output::Destination) -> Result<u8, Failure> {
    destination.put(&String::from_utf8_lossy(text))?;
    Ok(DONE)
}
