use super::moved::{moved, with_moved};
use super::*;
use crate::as_stated::finding_of;
use crate::depth::Depth;
use crate::exact::{ExactAllowance, ask_exact};
use crate::more_digits::MoreDigits;
use crate::options::AnalysisOptions;
use crate::part_samples::Posed;
use crate::pose_rank::{PartRank, rank_part};
use crate::vocabulary::Scope;
use kutzbach_closure::samples::{flat_parallelogram, four_bar, general_four, sarrus};
use kutzbach_format::read_file;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::{Path, PathBuf};

fn claim(engine: EngineName, finite: Bounds) -> Claim {
    Claim::of(engine, Scope::Pose, finite, "")
}

fn found(claims: impl IntoIterator<Item = Claim>) -> PartFinding {
    let mut found = PartFinding::new(9);
    claims.into_iter().for_each(|claim| found.take(claim));
    found
}

/// A claim that decides, with one branch of a dimension.
fn decides(engine: EngineName, finite: usize, dimension: usize) -> Claim {
    let branch = PartBranch {
        dimension,
        half_branches: None,
        poses: Vec::new(),
    };
    claim(engine, Bounds::exactly(finite)).decides(Answer {
        branches: Some(vec![branch]),
        ..Answer::numeric("so it is")
    })
}

#[test]
fn bounds_intersect_whatever_the_order() {
    let claims = [
        claim(EngineName::Rank, Bounds::at_most(3)),
        claim(
            EngineName::Germ,
            Bounds {
                lower: 1,
                upper: None,
            },
        ),
        claim(EngineName::Chart, Bounds::at_most(2)),
    ];
    let forward = found(claims.clone());
    let backward = found(claims.into_iter().rev());
    for found in [forward, backward] {
        assert_eq!((found.lower(), found.upper()), (1, 2));
        assert_eq!(found.contradictions(), []);
        assert!(found.open().is_some() && found.branches().is_none());
    }
    // Nothing is known of a part but its size.
    assert_eq!((found([]).lower(), found([]).upper()), (0, 9));
}

#[test]
fn bounds_that_exclude_one_another_open_the_part_whoever_claims_more_strongly() {
    for order in [[0, 1, 2], [2, 1, 0], [1, 2, 0]] {
        let claims = [
            claim(EngineName::Rank, Bounds::at_most(3)),
            decides(EngineName::Germ, 2, 2),
            claim(EngineName::Exact, Bounds::at_most(1)),
        ];
        let found = found(order.map(|index: usize| claims[index].clone()));
        assert_eq!(
            found.contradictions().len(),
            2,
            "{:?}",
            found.contradictions()
        );
        let said = found.open().unwrap();
        assert!(
            said.contains("`germ`") && said.contains("`exact`"),
            "{said}"
        );
        // Right is 2 if algebra is wrong, and at most 1 if the germ is.
        assert_eq!((found.lower(), found.upper()), (0, 2));
        assert!(found.branches().is_none() && found.level() == CertificateLevel::Numeric);
    }
}

#[test]
fn poses_and_branches_are_held_against_bounds() {
    let mut regular = decides(EngineName::Chart, 1, 1);
    regular.pose = Some(PoseKind::Regular);
    let mut singular = claim(EngineName::Exact, Bounds::at_most(1));
    singular.pose = Some(PoseKind::Singular);
    let both = found([regular, singular]);
    let engines = [EngineName::Chart, EngineName::Exact];
    assert_eq!(both.contradictions(), [Contradiction::Pose(engines)]);
    assert_eq!((both.pose(), both.open().is_some()), (None, true));
    // One engine contradicts itself.
    let own = found([decides(EngineName::Germ, 1, 2)]);
    let text = own.open().unwrap();
    assert!(
        text.contains("a branch of dimension 2, and the finite mobility is 1"),
        "{text}"
    );
}

#[test]
fn a_complex_dimension_in_doubt_leaves_the_real_freedom() {
    let mut germ = decides(EngineName::Germ, 1, 1);
    germ.complex = Bounds::exactly(2);
    let mut exact = claim(EngineName::Exact, Bounds::ANY);
    exact.complex = Bounds::at_most(1);
    let two = found([germ.clone(), exact]);
    assert_eq!((two.complex_dimension(), two.open()), (None, None));
    assert_eq!(
        (two.contradictions().len(), two.lower(), two.upper()),
        (1, 1, 1)
    );
    // Fewer complex solutions than real ones.
    germ.complex = Bounds::exactly(0);
    let less = found([germ]);
    assert_eq!((less.complex_dimension(), less.open()), (None, None));
    assert!(
        less.contradictions()[0]
            .to_string()
            .contains("over the complex numbers is 0")
    );
}

#[test]
fn numbers_read_otherwise_make_claims_void() {
    let mut found = found([decides(EngineName::Chart, 1, 1)]);
    found.read_anew(decides(EngineName::Digits, 0, 0));
    assert_eq!((found.lower(), found.upper(), found.open()), (0, 0, None));
    assert_eq!((found.contradictions(), found.claims().len()), (&[][..], 2));
}

/// What became of the claims of an engine that were moved.
#[derive(Default)]
struct Moved {
    parts: usize,
    contradicted: usize,
    same: usize,
    open: usize,
    wrong: usize,
}

/// Mechanisms of more joint variables are left out: they take long.
const MOST_UNKNOWNS: usize = 12;

fn mechanisms() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let files = ["mechanisms", "tests/zoo"].map(|folder| {
        let entries = std::fs::read_dir(root.join(folder)).unwrap();
        entries.map(|entry| entry.unwrap().path())
    });
    let mut files: Vec<PathBuf> = files.into_iter().flatten().collect();
    files.retain(|file| file.extension().is_some_and(|ending| ending == "urdf"));
    files.sort();
    files
}

fn findings(posed: &Posed, ranks: &[PartRank]) -> Vec<PartFinding> {
    let options = AnalysisOptions {
        depth: Depth::Verdict,
        ..AnalysisOptions::default()
    };
    let mut allowance = ExactAllowance::new(options.exact);
    let mut more = MoreDigits::new();
    let parts = posed.structure.parts.iter().zip(ranks);
    parts
        .map(|(part, rank)| {
            let asked = (part, rank);
            let pose = posed.pose();
            let mut found = finding_of(
                &pose,
                &mut more,
                &posed.structure,
                asked,
                &options,
                &mut allowance,
            )
            .unwrap();
            if found.open().is_none() {
                ask_exact(&pose, part, rank, &mut found, &mut allowance);
            }
            found
        })
        .collect()
}

/// What all claims of other engines leave.
fn without(found: &PartFinding, engine: EngineName) -> Option<Bounds> {
    let others = found.claims().iter().filter(|claim| claim.engine != engine);
    let mut finite = others.map(|claim| claim.finite);
    finite.try_fold(Bounds::ANY, Bounds::meet)
}

fn facts(found: &PartFinding) -> (usize, usize, bool) {
    (found.lower(), found.upper(), found.open().is_some())
}

/// Moves the claims of each engine about a mechanism, one engine at a time; `asked` are the findings with an engine moved. Gives
/// what is wrong.
fn move_claims(
    name: &str,
    plain: &[PartFinding],
    counts: &mut BTreeMap<EngineName, Moved>,
    asked: impl Fn() -> Vec<PartFinding>,
) -> Vec<String> {
    let claims = plain.iter().flat_map(|found| found.claims());
    let engines: BTreeSet<EngineName> = claims.map(|claim| claim.engine).collect();
    let mut wrong = Vec::new();
    for (engine, by) in engines.into_iter().flat_map(|e| [(e, -1), (e, 1)]) {
        let after = with_moved(engine, by, &asked);
        for (before, after) in plain.iter().zip(&after) {
            let own = after.claims().iter().filter(|claim| claim.engine == engine);
            let said = own
                .clone()
                .try_fold(Bounds::ANY, |sum, c| sum.meet(c.finite));
            let mut own = own.map(|claim| with_moved(engine, by, || moved(engine, claim.finite)));
            let claimed = own.try_fold(Bounds::ANY, Bounds::meet);
            if said == claimed {
                continue;
            }
            let excluded = match (claimed, without(after, engine)) {
                (Some(claimed), Some(others)) => claimed.meet(others).is_none(),
                _ => true,
            };
            let told = !after.contradictions().is_empty() && after.open().is_some();
            if excluded && !told {
                wrong.push(format!("{name}: {engine} {by:+}: {:?}", facts(after)));
            }
            let count = counts.entry(engine).or_default();
            count.parts += 1;
            match (told, facts(after)) {
                (true, _) => count.contradicted += 1,
                (_, now) if now == facts(before) => count.same += 1,
                (_, (_, _, true)) => count.open += 1,
                _ => count.wrong += 1,
            }
        }
    }
    wrong
}

fn table(counts: &BTreeMap<EngineName, Moved>) -> String {
    let mut table = String::from(
        "| engine | claims moved | contradiction | answer the same | left open | nobody else knew |\n|---|---|---|---|---|---|\n",
    );
    for (engine, count) in counts {
        let Moved {
            parts,
            contradicted,
            same,
            open,
            wrong,
        } = count;
        let _ = writeln!(
            table,
            "| {engine} | {parts} | {contradicted} | {same} | {open} | {wrong} |"
        );
    }
    table
}

fn ranks(posed: &Posed) -> Vec<PartRank> {
    let parts = posed.structure.parts.iter();
    parts
        .map(|part| rank_part(&posed.pose(), part).unwrap())
        .collect()
}

/// What is asked after an engine that is wrong does not hide that it is.
#[test]
fn a_wrong_claim_is_found_out_by_engines_asked_later() {
    for (mechanism, wrong, by) in [
        (general_four(), EngineName::Rank, 1),
        (four_bar(), EngineName::Subgroup, 1),
        (sarrus(), EngineName::Subgroup, 1),
        (flat_parallelogram(), EngineName::Chart, -1),
        (flat_parallelogram(), EngineName::Germ, 1),
    ] {
        let posed = Posed::new(mechanism);
        let ranks = ranks(&posed);
        let found = with_moved(wrong, by, || findings(&posed, &ranks));
        let [found] = &found[..] else {
            panic!("one part")
        };
        let said = found.open().unwrap();
        assert!(said.contains(&format!("engine `{wrong}`")), "{said}");
    }
}

/// One engine at a time claims a freedom more, or fewer, than it found, of every mechanism: where another claim excludes that, the
/// report says so, and the table in the documentation says how often one does.
#[test]
fn a_wrong_claim_that_another_excludes_is_a_contradiction() {
    let files = mechanisms();
    let half = files.len().div_ceil(2);
    let work = |files: &[PathBuf]| {
        let mut counts = BTreeMap::new();
        let mut wrong = Vec::new();
        for file in files {
            let name = file.file_stem().unwrap().to_string_lossy().into_owned();
            let read = read_file(file, &[]).ok().map(|read| read.mechanism);
            let small = read.filter(|mechanism| mechanism.freedom() <= MOST_UNKNOWNS);
            let Some(posed) = small.and_then(Posed::closed) else {
                continue;
            };
            let plain = findings(&posed, &ranks(&posed));
            let anew = || {
                let mut found = plain.clone();
                found.iter_mut().for_each(PartFinding::judge);
                found
            };
            wrong.append(&mut move_claims(&name, &plain, &mut counts, anew));
        }
        (counts, wrong)
    };
    let ((mut counts, mut wrong), (more, mut also)) = std::thread::scope(|scope| {
        let other = scope.spawn(|| work(&files[half..]));
        (work(&files[..half]), other.join().unwrap())
    });
    for (engine, more) in more {
        let sum: &mut Moved = counts.entry(engine).or_default();
        sum.parts += more.parts;
        sum.contradicted += more.contradicted;
        sum.same += more.same;
        sum.open += more.open;
        sum.wrong += more.wrong;
    }
    wrong.append(&mut also);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/mobility.md");
    let text = std::fs::read_to_string(&page).unwrap();
    let table = table(&counts);
    let from = text.find("| engine | claims moved |").unwrap();
    let end = text[from..].find("\n\n").unwrap() + from + 1;
    if text[from..end] != table && std::env::var_os("KUTZBACH_UPDATE").is_some() {
        std::fs::write(&page, format!("{}{table}{}", &text[..from], &text[end..])).unwrap();
    } else {
        assert_eq!(
            text[from..end],
            table,
            "to write it anew: KUTZBACH_UPDATE=1"
        );
    }
}
