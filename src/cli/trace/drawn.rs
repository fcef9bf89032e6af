//! What `--plot` and `--curve` ask for, and the pictures of it.

use super::super::failure::Failure;
use super::super::pose::measured;
use clap::Args;
use kutzbach::mechanism::{FreedomPart, Mechanism};
use kutzbach::motion::{Motion, Trace, TraceError, Variable, variable_named};
use kutzbach::report::definitions::closest;
use kutzbach::report::picture::plot::sheet;
use kutzbach::report::picture::traced::relation;
use kutzbach::report::traced::LinkPoint;

/// What is drawn.
#[derive(Debug, Args)]
pub struct Drawn {
    /// Plot one joint over another, with `--format svg`: `rocker:crank` has the rocker on the vertical axis and the crank on the
    /// horizontal one (degrees, mm); of a joint with several degrees of freedom one of them, as `slider.rot`; may be repeated
    #[arg(long = "plot", value_name = "JOINT:JOINT")]
    plots: Vec<String>,
    /// Path of a point fixed to a link, its coordinates in the link's frame (m, or with a unit): `coupler:1,0.5` or
    /// `coupler:20mm,0,5mm`. `--format svg` draws it in its plane with equal scales (mm), seen along the normal of its best
    /// plane where it has none; the other forms list it; may be repeated
    #[arg(
        long = "curve",
        value_name = "LINK:X,Y[,Z]",
        allow_hyphen_values = true
    )]
    curves: Vec<String>,
}

/// What is drawn, found in the mechanism.
#[derive(Debug)]
pub struct Found {
    /// Vertical and horizontal axis of each plot.
    plots: Vec<[Variable; 2]>,
    /// Points whose paths are wanted.
    pub points: Vec<LinkPoint>,
}

impl Drawn {
    /// Finds what is named.
    ///
    /// # Errors
    /// For what is written otherwise, for names that are not known, and where nothing or no picture is asked for.
    pub fn find(&self, mechanism: &Mechanism, as_picture: bool) -> Result<Found, Failure> {
        let plain = |message: &str, help: &str| Failure::Plain {
            message: message.to_owned(),
            help: Some(help.to_owned()),
        };
        if as_picture && self.plots.is_empty() && self.curves.is_empty() {
            return Err(plain(
                "`--format svg` is not told what to draw",
                "`--plot rocker:crank` plots one joint over another, `--curve coupler:x,y` draws the path of a point",
            ));
        }
        if !as_picture && !self.plots.is_empty() {
            return Err(plain("`--plot` is a picture", "add `--format svg`"));
        }
        let plots = self.plots.iter().map(|text| pair(mechanism, text));
        let points = self.curves.iter().map(|text| point(mechanism, text));
        Ok(Found {
            plots: plots.collect::<Result<_, _>>()?,
            points: points.collect::<Result<_, _>>()?,
        })
    }
}

impl Found {
    /// The pictures below one another.
    ///
    /// # Errors
    /// Where nothing moves.
    pub fn svg(&self, mechanism: &Mechanism, trace: &Trace) -> Result<String, Failure> {
        let motion: &Motion = match trace {
            Trace::Moving(motion) => motion,
            Trace::Still(still) => {
                return Err(Failure::Plain {
                    message: format!("{}: no motion to draw: {}", mechanism.name(), still.reason),
                    help: None,
                });
            }
        };
        let plots = self.plots.iter();
        let plots = plots.map(|[y, x]| relation(mechanism, motion, y, x));
        let curves = self.points.iter().map(|point| point.plot(motion));
        Ok(sheet(&plots.chain(curves).collect::<Vec<_>>()))
    }
}

/// Reads `joint:joint`. Names may hold colons: of several readings, the first whose names are known.
fn pair(mechanism: &Mechanism, text: &str) -> Result<[Variable; 2], Failure> {
    let failed = |message: String, help: String| Failure::Plain {
        message: format!("`--plot {text}`: {message}"),
        help: Some(help),
    };
    let mut first: Option<TraceError> = None;
    for (at, _) in text.match_indices(':') {
        let named = |name: &str| variable_named(mechanism, name.trim());
        match named(&text[..at]).and_then(|y| Ok([y, named(&text[at + 1..])?])) {
            Ok(found) => return Ok(found),
            Err(error) => first = first.or(Some(error)),
        }
    }
    Err(match first {
        Some(error) => failed(error.to_string(), error.help()),
        None => failed(
            "two joints are needed".to_owned(),
            "write it as vertical:horizontal, for example `rocker:crank`".to_owned(),
        ),
    })
}

/// Reads `link:x,y` or `link:x,y,z`.
///
/// # Errors
/// For what is written otherwise, and for a link that is not known.
pub fn point(mechanism: &Mechanism, text: &str) -> Result<LinkPoint, Failure> {
    const WRITTEN: &str = "write it as link:x,y or link:x,y,z in the frame of the link, for example `coupler:1,0.5` (m) or \
                           `coupler:20mm,0,5mm`";
    let failed = |message: String, help: String| Failure::Plain {
        message: format!("`--curve {text}`: {message}"),
        help: Some(help),
    };
    let malformed = |message: String| failed(message, WRITTEN.to_owned());
    let (name, coordinates) = text
        .rsplit_once(':')
        .ok_or_else(|| malformed("no link is named".to_owned()))?;
    let name = name.trim();
    let link = mechanism.link_named(name).ok_or_else(|| {
        let known = mechanism.links().iter().map(|link| link.name.as_str());
        failed(
            format!("there is no link `{name}`"),
            match closest(name, known) {
                Some(known) => format!("did you mean `{known}`?"),
                None => "`kutzbach graph FILE` lists all links".to_owned(),
            },
        )
    })?;
    let words: Vec<&str> = coordinates.split(',').map(str::trim).collect();
    if !(2..=3).contains(&words.len()) {
        return Err(malformed(format!(
            "a point has 2 or 3 coordinates, given: {}",
            words.len()
        )));
    }
    let mut at = [0.0; 3];
    for (place, word) in at.iter_mut().zip(&words) {
        let number = measured(word, FreedomPart::Translation)
            .map_err(|why| malformed(format!("`{word}` is no length: {why}")))?;
        *place = number.value();
        if !place.is_finite() {
            return Err(malformed(format!("`{word}` is not finite")));
        }
    }
    let [x, y, z] = at;
    Ok(LinkPoint {
        name: format!("{name}({x} {y} {z})"),
        link: link.0,
        at,
    })
}
