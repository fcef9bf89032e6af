//! From a mechanism to a report.
//!
//! Counting and the tables of joints and couplings need the mechanism alone and are filled in here. What an analysis finds
//! is laid over them; what it does not reach stays `null`.

use super::asked::{HOME, Options, ReportDepth, ReportError};
use super::natural::natural_order;
use super::schema::{
    Assembly, Constants, CouplingRow, Home, JointRow, LiteralAt, LiteralReading, Mobility, Report,
    SCHEMA, Size, Source, Timing, Warning, WrittenKind, WrittenStyle,
};
use kutzbach_format::Reading;
use kutzbach_math::number::Number;
use kutzbach_mobility::Verdict;
use kutzbach_mobility::{Analysis, AnalysisOptions, analyse, kutzbach_count};
use kutzbach_model::mechanism::{
    Coupling, LiteralPlace, Mechanism, OtherUnit, Placement, Precision, Written,
};
use petgraph::unionfind::UnionFind;
use std::time::Instant;

/// What is reported on.
#[derive(Clone, Copy, Debug)]
pub struct Input<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// The file as the caller named it.
    pub file: &'a str,
    /// The file's format, such as `urdf`.
    pub format: &'a str,
    /// What its reader wants to be known.
    pub warnings: &'a [Warning],
    /// What of the file was not read.
    pub skipped: &'a [String],
}

/// The report on a mechanism read from a file.
///
/// # Errors
/// [`ReportError`] where the options ask for what the mechanism does not have.
pub fn report(reading: &Reading, file: &str, options: &Options) -> Result<Report, ReportError> {
    analysed_report(reading, file, options).map(|(report, _)| report)
}

/// The report on a mechanism read from a file, and the analysis that it tells of.
///
/// # Errors
/// [`ReportError`] where the options ask for what the mechanism does not have.
pub fn analysed_report(
    reading: &Reading,
    file: &str,
    options: &Options,
) -> Result<(Report, Analysis), ReportError> {
    let warnings: Vec<Warning> = reading.warnings.iter().map(Warning::from).collect();
    let skipped: Vec<String> = reading
        .skipped
        .iter()
        .map(|skipped| {
            let place = format!("line {}, column {}", skipped.line, skipped.column);
            match skipped.count {
                1 => format!("{place}: {}", skipped.what),
                count => format!("{count} × {} (first at {place})", skipped.what),
            }
        })
        .collect();
    let input = Input {
        mechanism: &reading.mechanism,
        file,
        format: reading.format,
        warnings: &warnings,
        skipped: &skipped,
    };
    analysed_report_on(&input, options)
}

/// The report on a mechanism from anywhere, such as one built in code.
///
/// # Errors
/// [`ReportError`] where the options ask for what the mechanism does not have.
pub fn report_on(input: &Input<'_>, options: &Options) -> Result<Report, ReportError> {
    analysed_report_on(input, options).map(|(report, _)| report)
}

/// The report, and the analysis that it tells of.
///
/// # Errors
/// [`ReportError`] where the options ask for what the mechanism does not have.
pub fn analysed_report_on(
    input: &Input<'_>,
    options: &Options,
) -> Result<(Report, Analysis), ReportError> {
    let mechanism = input.mechanism;
    let configuration = match options.configuration.as_deref() {
        Some(name) if name != HOME && mechanism.configuration(name).is_none() => {
            return Err(ReportError::UnknownConfiguration {
                name: name.to_owned(),
                mechanism: mechanism.name().to_owned(),
                known: mechanism
                    .configurations()
                    .iter()
                    .map(|c| c.name.clone())
                    .collect(),
            });
        }
        Some(name) => name,
        None => HOME,
    };
    let pairs = super::extras::pairs(mechanism, &options.between)?;
    let inputs = super::inputs::asked(mechanism, &options.inputs)?;
    let started = Instant::now();
    let analysis = analyse(
        mechanism,
        &AnalysisOptions {
            configuration: configuration_of(mechanism, configuration).map(str::to_owned),
            exact: options.exact,
            depth: options.depth.into(),
            closure_tolerance: options.closure_tolerance,
        },
    )?;
    let mut report = counted(input, configuration);
    // Where rounded numbers mean another mechanism, everything below is said of that one.
    let given = mechanism;
    let mechanism = analysis.of(mechanism);
    super::findings::lay_over(&mut report, mechanism, &analysis);
    report.assembly.tolerance_asked = options.closure_tolerance.is_some();
    if options.depth == ReportDepth::Everything {
        report.four_bars = kutzbach_motion::four_bars(mechanism, &analysis);
        let followed =
            super::inputs::lay_over(&mut report, mechanism, &analysis, configuration, inputs);
        super::pose::warn(&mut report, mechanism, &analysis, configuration);
        super::extras::ask_between(&mut report, mechanism, &analysis, &pairs);
        if options.ranges {
            super::ranges::lay_over(&mut report, mechanism, &analysis, configuration, followed);
        }
        let there = configuration_of(given, configuration);
        super::play::lay_over(&mut report, given, &analysis, there, options);
    } else {
        report.depth = Some(options.depth);
    }
    if options.evidence {
        report.evidence = Some(super::extras::evidence(&report, &analysis));
    }
    if options.timing {
        let total_ms = started.elapsed().as_secs_f64() * 1e3;
        report.timing = Some(Timing {
            total_ms,
            stages: Vec::new(),
        });
    }
    Ok((report, analysis))
}

/// The configuration to look up: none for the home pose, unless the file gives it values.
fn configuration_of<'a>(mechanism: &Mechanism, name: &'a str) -> Option<&'a str> {
    (name != HOME || mechanism.configuration(HOME).is_some()).then_some(name)
}

/// How the kinds of numbers are written that are not exact.
fn written(precision: &Precision) -> Vec<WrittenKind> {
    let kinds = ["lengths", "angles", "directions"].into_iter();
    let row = |(kind, written): (&str, Option<Written>)| {
        let (style, decimals, significant) = match written? {
            Written::Chosen => return None,
            Written::Decimals(decimals) => (WrittenStyle::Decimals, Some(decimals), None),
            Written::Significant(digits) => (WrittenStyle::Significant, None, Some(digits)),
            Written::Either(decimals, digits) => {
                (WrittenStyle::Either, Some(decimals), Some(digits))
            }
            Written::SinglePrecision => (WrittenStyle::Single, None, None),
            Written::DoublePrecision => (WrittenStyle::Double, None, None),
            Written::Converted(unit, decimals) => {
                let style = match unit {
                    OtherUnit::Degree => WrittenStyle::Degrees,
                    OtherUnit::Inch => WrittenStyle::Inches,
                };
                (style, Some(decimals), None)
            }
        };
        Some(WrittenKind {
            kind: kind.to_owned(),
            style,
            decimals,
            significant,
        })
    };
    match precision.by_hand() {
        Some(_) => Vec::new(),
        None => kinds.zip(precision.written()).filter_map(row).collect(),
    }
}

fn rounded_by(mechanism: &Mechanism) -> Option<LiteralAt> {
    let (number, owner) = match mechanism.precision().rounded_by()? {
        LiteralPlace::Joint(joint, place) => {
            let joint = &mechanism.joints()[joint];
            (joint.numbers()[place]?, &joint.name)
        }
        LiteralPlace::Link(link, place) => {
            let link = &mechanism.links()[link];
            let Placement::Floating { origin, .. } = &link.placement else {
                return None;
            };
            let mut numbers = origin.position.iter().chain(&origin.roll_pitch_yaw);
            (numbers.nth(place)?, &link.name)
        }
    };
    // Of a number that was worked out, the longest of the literals behind it.
    let decimals = |literal: &&Number| literal.stated().map(|stated| stated.decimals);
    Some(LiteralAt {
        literal: number
            .literals()
            .max_by_key(decimals)?
            .literal_text()?
            .to_owned(),
        owner: owner.clone(),
    })
}

fn residues(mechanism: &Mechanism) -> Vec<LiteralAt> {
    let residues = mechanism.recognised().residues.iter();
    residues
        .map(|residue| LiteralAt {
            literal: residue.text.clone(),
            owner: mechanism.joints()[residue.joint].name.clone(),
        })
        .collect()
}

fn constants(mechanism: &Mechanism) -> Option<Constants> {
    let found = mechanism.recognised();
    let readings = found
        .examples
        .iter()
        .map(|(literal, read_as)| LiteralReading {
            literal: literal.clone(),
            read_as: read_as.clone(),
        });
    (found.count > 0).then(|| Constants {
        count: found.count,
        readings: readings.collect(),
    })
}

/// A report that holds what counting alone tells.
fn counted(input: &Input<'_>, configuration: &str) -> Report {
    let mechanism = input.mechanism;
    let parts = connected_parts(mechanism);
    let size = Size {
        links: mechanism.links().len(),
        joints: mechanism.joints().len(),
        loops: mechanism.joints().len() + parts - mechanism.links().len(),
        couplings: mechanism.couplings().len(),
        freedoms: mechanism.freedom(),
    };
    let unknowns = size.freedoms + 6 * (parts - 1);
    let precision = mechanism.precision();
    Report {
        schema: SCHEMA.to_owned(),
        mechanism: mechanism.name().to_owned(),
        source: Source {
            file: input.file.to_owned(),
            format: input.format.to_owned(),
            digits: precision.decimals,
            exact: precision.is_exact(),
            written: written(precision),
            precision: precision.by_hand(),
            constants: constants(mechanism),
            rounded_by: rounded_by(mechanism),
            residues: residues(mechanism),
        },
        kutzbach: kutzbach_count(mechanism),
        generic: None,
        assembly: Assembly::default(),
        home: Home {
            configuration: configuration.to_owned(),
            pose: None,
            kind: None,
            instantaneous: None,
            // Equations take no more freedoms than they are many, and independent ones no fewer than none.
            candidates: [
                usize::try_from(kutzbach_count(mechanism)).unwrap_or(0),
                unknowns,
            ],
            as_written: None,
            redundant: None,
            rank: None,
            equations: 6 * size.loops + size.couplings,
            unknowns,
            gap: None,
            kept: None,
            dropped: None,
            tolerance: None,
            accuracy: None,
            method: String::new(),
            bits: None,
            blocks: Vec::new(),
            weakest: None,
            note: None,
        },
        mobility: Mobility {
            verdict: Verdict::Undecided,
            finite: None,
            bounds: [None, None],
            complex_dimension: None,
            class: None,
            certificate: None,
            nominal: None,
            as_written: None,
            why: Vec::new(),
        },
        freedoms: None,
        inputs: None,
        branches: None,
        joints: joint_rows(mechanism),
        four_bars: Vec::new(),
        couplings: coupling_rows(mechanism),
        cycles: Vec::new(),
        tree: None,
        motions: Vec::new(),
        advice: Vec::new(),
        change_sets: None,
        play: None,
        warnings: input.warnings.to_vec(),
        skipped: input.skipped.to_vec(),
        evidence: None,
        timing: None,
        depth: None,
        size,
    }
}

fn joint_rows(mechanism: &Mechanism) -> Vec<JointRow> {
    let mut rows: Vec<JointRow> = mechanism
        .joints()
        .iter()
        .map(|joint| JointRow {
            name: joint.name.clone(),
            class: joint.kind.class().to_owned(),
            kind: joint.kind.word().to_owned(),
            links: [
                mechanism.link(joint.predecessor.link).name.clone(),
                mechanism.link(joint.successor.link).name.clone(),
            ],
            freedom: joint.freedom(),
            locked: None,
            locked_parts: Vec::new(),
            redundant_wrenches: None,
            redundant_directions: Vec::new(),
            closes_loop: joint.closes_loop,
            block: None,
            ranges: Vec::new(),
        })
        .collect();
    rows.sort_by(|a, b| natural_order(&a.name, &b.name));
    rows
}

fn coupling_rows(mechanism: &Mechanism) -> Vec<CouplingRow> {
    let mut rows: Vec<CouplingRow> = mechanism
        .couplings()
        .iter()
        .map(|coupling| CouplingRow {
            name: coupling.name.clone(),
            text: equation(mechanism, coupling),
        })
        .collect();
    rows.sort_by(|a, b| natural_order(&a.name, &b.name));
    rows
}

/// A coupling as an equation, `2 a − b = 0.5`; numbers as the file wrote them.
fn equation(mechanism: &Mechanism, coupling: &Coupling) -> String {
    let mut text = String::new();
    for term in &coupling.terms {
        let name = &mechanism.joint(term.joint).name;
        for (factor, power) in term.factors().zip(["", "²", "³", "⁴"]) {
            if !factor.is_zero() {
                add_term(&mut text, factor, &format!("{name}{power}"));
            }
        }
    }
    text.push_str(" = ");
    text.push_str(&plain(&coupling.offset));
    text
}

fn add_term(text: &mut String, factor: &Number, variable: &str) {
    let negative = factor.value() < 0.0;
    let size = plain(&if negative { -factor } else { factor.clone() });
    text.push_str(match (text.is_empty(), negative) {
        (true, false) => "",
        (true, true) => "−",
        (false, false) => " + ",
        (false, true) => " − ",
    });
    if size != "1" {
        text.push_str(&size);
        text.push(' ');
    }
    text.push_str(variable);
}

/// A number as the file wrote it, without the braces of an expression.
fn plain(number: &Number) -> String {
    let source = number.source();
    match source.strip_prefix("${").and_then(|s| s.strip_suffix('}')) {
        Some(inner) => inner.to_owned(),
        None => source,
    }
}

/// The number of connected parts of the links under the joints.
fn connected_parts(mechanism: &Mechanism) -> usize {
    let mut parts = UnionFind::<usize>::new(mechanism.links().len());
    let joins = mechanism
        .joints()
        .iter()
        .filter(|joint| parts.union(joint.predecessor.link.0, joint.successor.link.0))
        .count();
    mechanism.links().len() - joins
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use kutzbach_format::read;

    /// ```text
    ///   crank ──B── coupler
    ///     │            │
    ///     A            C      D: ground ── rocker
    ///     │            │
    ///   ground ──D── rocker        loose: no joint
    /// ```
    fn four_bar(joints: &[&str], extra: &str) -> Report {
        let all = [
            r#"<joint name="J10" type="revolute"><parent link="ground"/><child link="crank"/></joint>"#,
            r#"<joint name="J2" type="revolute"><parent link="crank"/><child link="coupler"/></joint>"#,
            r#"<joint name="J1" type="cylindrical"><parent link="ground"/><child link="rocker"/></joint>"#,
        ];
        let closing = r#"<loop name="C" type="revolute"><predecessor link="coupler"><origin xyz="0 0 0"/></predecessor>
            <successor link="rocker"><origin xyz="0 0 0"/></successor></loop>"#;
        let joints: String = joints
            .iter()
            .map(|name| {
                all.iter()
                    .find(|text| text.contains(&format!("\"{name}\"")))
                    .unwrap()
            })
            .copied()
            .collect();
        let text = format!(
            r#"<robot name="bar"><link name="ground"/><link name="crank"/><link name="coupler"/><link name="rocker"/>
            {joints}{closing}{extra}</robot>"#
        );
        let reading = read(&text, "bar.urdf", &[]).unwrap();
        report(&reading, "bar.urdf", &Options::default()).unwrap()
    }

    #[test]
    fn counts_follow_the_formulas() {
        let report = four_bar(&["J10", "J2", "J1"], "");
        // 6 (4 − 1) − (5 + 5 + 4 + 5)
        assert_eq!(report.kutzbach, -1);
        assert_eq!(report.size.loops, 1);
        assert_eq!(report.home.unknowns, 5);
        assert_eq!(report.home.equations, 6);
    }

    #[test]
    fn parts_without_a_joint_count_with_six_freedoms() {
        let report = four_bar(
            &["J10", "J2", "J1"],
            r#"<link name="loose"/><joint name="f" type="floating"><parent link="ground"/><child link="loose"/></joint>"#,
        );
        assert_eq!(report.kutzbach, 5);
        assert_eq!(report.size.loops, 1);
        let (unknowns, equations) = (report.home.unknowns, report.home.equations);
        assert_eq!(unknowns as i64 - equations as i64, report.kutzbach);
    }

    #[test]
    fn rows_do_not_follow_the_file() {
        let report = four_bar(&["J10", "J2", "J1"], "");
        let names: Vec<&str> = report.joints.iter().map(|j| j.name.as_str()).collect();
        assert_eq!(names, ["C", "J1", "J2", "J10"]);
        let other = four_bar(&["J1", "J10", "J2"], "");
        assert_eq!(other.joints, report.joints);
    }

    #[test]
    fn unknown_configurations_are_refused_with_those_there_are() {
        let text = r#"<robot name="one"><link name="a"/><link name="b"/>
            <joint name="J" type="revolute"><parent link="a"/><child link="b"/></joint>
            <configuration name="open"><position joint="J" value="0.3"/></configuration></robot>"#;
        let reading = read(text, "one.urdf", &[]).unwrap();
        let at = |name: &str| {
            let options = Options {
                configuration: Some(name.to_owned()),
                ..Options::default()
            };
            report(&reading, "one.urdf", &options)
        };
        assert_eq!(at("open").unwrap().home.configuration, "open");
        assert_eq!(at("home").unwrap().home.configuration, "home");
        let error = at("opened").unwrap_err();
        assert!(error.help().contains("open"));
    }
}
