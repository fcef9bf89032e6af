use super::*;
use crate::format::read_file;
use crate::mechanism::Mechanism;
use crate::mobility::{Analysis, AnalysisOptions, analyse};

fn zoo(name: &str) -> Mechanism {
    let path = format!("{}/tests/zoo/{name}.urdf", env!("CARGO_MANIFEST_DIR"));
    read_file(path, &[]).unwrap().mechanism
}

fn analysed(mechanism: &Mechanism) -> Analysis {
    analyse(mechanism, &AnalysisOptions::default()).unwrap()
}

fn germ_of(name: &str, degree: usize) -> Germ {
    let mechanism = zoo(name);
    let analysis = analysed(&mechanism);
    assert_eq!(analysis.parts.len(), 1);
    Germ::of_part(&mechanism, &analysis.parts[0], degree)
        .unwrap()
        .unwrap()
}

#[test]
fn survey() {
    let mut names: Vec<String> =
        std::fs::read_dir(format!("{}/tests/zoo", env!("CARGO_MANIFEST_DIR")))
            .unwrap()
            .filter_map(|e| {
                e.unwrap()
                    .path()
                    .file_name()
                    .unwrap()
                    .to_str()
                    .unwrap()
                    .strip_suffix(".urdf")
                    .map(str::to_owned)
            })
            .collect();
    names.sort();
    for name in names {
        let mechanism = zoo(&name);
        let analysis = analysed(&mechanism);
        for rank in &analysis.parts {
            let start = std::time::Instant::now();
            let Some(germ) = Germ::of_part(&mechanism, rank, 4).unwrap() else {
                println!(
                    "{name}: none ({:?} {})",
                    rank.instantaneous,
                    rank.unknowns()
                );
                continue;
            };
            let took = start.elapsed();
            let cert = prestress_certificate(&germ);
            let start = std::time::Instant::now();
            let dim = complex_dimension(germ.equations(), germ.freedom(), germ.noise_by_degree());
            let took2 = start.elapsed();
            println!(
                "{name}: unknowns {} δ {} order {:?} eqs {} margin {:.1e} noise {:.1e} {:.1e} {:?}\n     cert {:?} dim {:?} {:?} stated {:.1e} acc {:.1e}",
                rank.unknowns(),
                germ.freedom(),
                germ.order(),
                germ.equations().len(),
                germ.margin(),
                germ.noise(2),
                germ.noise(4),
                took,
                cert.map(|c| (c.smallest_eigenvalue, c.noise)),
                dim,
                took2,
                rank.stated,
                rank.accuracy
            );
        }
    }
}
