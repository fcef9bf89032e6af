//! Pages: complete in themselves, harmless whatever a file is called, and true to the trace.

use crate::support;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use kutzbach::format::read_file;
use kutzbach::mobility::{AnalysisOptions, analyse};
use kutzbach::motion::{TraceOptions, trace};
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};
use std::process::Output;
use support::folder;

fn scratch(name: &str) -> PathBuf {
    support::empty_folder(&format!("html_page/{name}"))
}

fn kutzbach(arguments: &[&str]) -> Output {
    let run = crate::support::program().args(arguments).output();
    run.unwrap()
}

fn page_of(file: &Path, more: &[&str]) -> String {
    let file = file.to_string_lossy();
    let mut arguments = vec!["report", file.as_ref(), "--format", "html"];
    arguments.extend(more);
    let run = kutzbach(&arguments);
    assert!(
        run.status.success(),
        "{}",
        String::from_utf8_lossy(&run.stderr)
    );
    String::from_utf8(run.stdout).unwrap()
}

fn page(name: &str) -> String {
    page_of(&folder(&format!("mechanisms/{name}.urdf")), &[])
}

/// What stands between two marks.
fn between<'a>(text: &'a str, from: &str, to: &str) -> &'a str {
    let start = text.find(from).unwrap() + from.len();
    let length = text[start..].find(to).unwrap();
    &text[start..start + length]
}

fn data(page: &str) -> Value {
    let text = between(
        page,
        "<script type=\"application/json\" id=\"page-data\">",
        "</script>",
    );
    serde_json::from_str(text).unwrap()
}

fn numbers(packed: &Value) -> Vec<f64> {
    let bytes = STANDARD.decode(packed.as_str().unwrap()).unwrap();
    let floats = bytes.chunks_exact(4);
    floats
        .map(|b| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]])))
        .collect()
}

#[test]
fn a_page_allows_its_own_script_and_style_and_nothing_else() {
    let page = page("bennett");
    let policy = between(
        &page,
        "http-equiv=\"Content-Security-Policy\" content=\"",
        "\"",
    );
    let hash = |text: &str| format!("'sha256-{}'", STANDARD.encode(Sha256::digest(text)));
    let style = between(&page, "<style>", "</style>");
    let script = between(&page, "</script>\n<script>", "</script>");
    assert!(policy.starts_with("default-src 'none';"), "{policy}");
    assert!(
        policy.contains(&format!("script-src {};", hash(script))),
        "{policy}"
    );
    assert!(
        policy.contains(&format!("style-src {};", hash(style))),
        "{policy}"
    );
    let markup = page.replace(script, "").replace(style, "");
    for loads in [
        " src=", "style=\"", "http://", "https://", "@import", "url(",
    ] {
        assert!(!markup.contains(loads), "{loads}");
    }
    for loads in ["@import", "url(", "@font-face"] {
        assert!(!style.contains(loads), "{loads}");
    }
    assert!(page.len() < 1_500_000, "{} bytes", page.len());
}

#[test]
fn poses_in_the_page_are_those_of_the_trace() {
    for name in [
        "bennett",
        "parallelogram_flat",
        "slider_crank",
        "cartesian_table",
    ] {
        let data = data(&page(name));
        let mechanism = read_file(folder(&format!("mechanisms/{name}.urdf")), &[])
            .unwrap()
            .mechanism;
        let analysis = analyse(&mechanism, &AnalysisOptions::default()).unwrap();
        let extent = data["extent"].as_f64().unwrap();
        let centre: Vec<f64> = serde_json::from_value(data["centre"].clone()).unwrap();
        let motions = data["motions"].as_array().unwrap();
        assert!(!motions.is_empty(), "{name}");
        for motion in motions {
            let branch = &data["branches"][motion["branch"].as_u64().unwrap() as usize];
            let dimension = branch["dimension"].as_u64().unwrap();
            let driven = motion["drives"][0].as_u64().unwrap() as usize;
            let variables = kutzbach::motion::Variable::all(&mechanism);
            let options = TraceOptions {
                branch: Some(branch["name"].as_str().unwrap().to_owned()),
                drive: (dimension > 1).then(|| variables[driven].name.clone()),
                ..TraceOptions::default()
            };
            let traced = trace(&mechanism, &analysis, &options).unwrap();
            let mut traced = traced.into_motion().unwrap();
            let (arclengths, poses) = (numbers(&motion["arclengths"]), numbers(&motion["poses"]));
            let links = mechanism.links().len();
            assert_eq!(poses.len(), arclengths.len() * links * 7, "{name}");
            let (first, last) = traced.curve.arclengths();
            for (sample, arclength) in arclengths.iter().enumerate() {
                let found = traced
                    .curve
                    .pose_at_arclength(arclength.clamp(first, last))
                    .unwrap();
                for (link, pose) in traced.curve.link_poses(&found.pose).iter().enumerate() {
                    let shown = &poses[(sample * links + link) * 7..][..7];
                    for axis in 0..3 {
                        let off = pose.translation[axis] - centre[axis] - shown[axis];
                        assert!(off.abs() < 1e-5 * extent, "{name} {sample} {link}: {off}");
                    }
                    let [x, y, z, w] = pose.quaternion();
                    let along = w * shown[3] + x * shown[4] + y * shown[5] + z * shown[6];
                    assert!(along.abs() > 1.0 - 1e-6, "{name} {sample} {link}: {along}");
                }
            }
        }
    }
}

/// A four-bar whose every name wants to be more than a name.
fn hostile() -> PathBuf {
    folder("tests/pages/hostile_names.urdf")
}

#[test]
fn names_are_text_everywhere() {
    let file = hostile();
    let plain = kutzbach(&["report", &file.to_string_lossy()]);
    assert!(
        plain.status.success(),
        "{}",
        String::from_utf8_lossy(&plain.stderr)
    );
    let page = page_of(&file, &[]);
    assert!(!page.contains("<img"));
    // The script's own, the one of the data and nothing that a name has opened or closed.
    assert_eq!(page.matches("</script").count(), 2);
    let data = data(&page);
    let first = data["links"][0]["name"].as_str().unwrap();
    assert_eq!(first, "<img src=x onerror=alert(0)></script>\"'`");
    assert!(page.matches("&lt;img src=x onerror=alert(1)&gt;").count() > 3);
}

#[test]
fn a_gallery_has_a_page_for_every_file_and_says_what_it_could_not_read() {
    let from = scratch("gallery_from");
    for name in ["bennett", "shaky_triangle", "kelvin_clamp"] {
        let file = format!("{name}.urdf");
        std::fs::copy(folder("mechanisms").join(&file), from.join(&file)).unwrap();
    }
    std::fs::write(
        from.join("broken.urdf"),
        "<robot name=\"b\"><link/></robot>",
    )
    .unwrap();
    std::fs::copy(hostile(), from.join("index.urdf")).unwrap();
    let to = scratch("gallery_to");
    let (from, out) = (
        from.to_string_lossy().into_owned(),
        to.to_string_lossy().into_owned(),
    );
    let run = kutzbach(&["gallery", &from, "-o", &out]);
    assert_eq!(run.status.code(), Some(2));
    let told = String::from_utf8_lossy(&run.stderr);
    assert!(
        told.contains("broken.urdf") && told.contains("name"),
        "{told}"
    );
    let index = std::fs::read_to_string(to.join("index.html")).unwrap();
    let read = |name: &str| std::fs::read_to_string(to.join(name)).unwrap();
    for name in [
        "bennett.html",
        "shaky_triangle.html",
        "kelvin_clamp.html",
        "index-1.html",
    ] {
        assert!(index.contains(&format!("href=\"{name}\"")), "{name}");
        assert!(read(name).contains("id=\"page-data\""), "{name}");
    }
    assert!(index.contains("broken.urdf") && !index.contains("href=\"broken.html\""));
    assert!(!index.contains("<img"));
    assert!(read("viewer.js").len() > 100_000 && read("page.css").contains("svg.plot"));
}

#[test]
fn the_same_mechanism_gives_the_same_page() {
    for name in ["bennett", "parallelogram_flat", "stewart"] {
        assert!(page(name) == page(name), "{name}");
    }
}

#[test]
fn a_verification_is_shown_where_it_was_asked_for() {
    let file = folder("mechanisms/slider_crank.urdf");
    let page = page_of(&file, &["--verify"]);
    assert!(page.contains("The physics engine says: confirmed."));
    assert!(page.contains("substeps of a step"));
    assert!(!self::page("slider_crank").contains("The physics engine says"));
    let refused = kutzbach(&["report", &file.to_string_lossy(), "--verify"]);
    assert_eq!(refused.status.code(), Some(2));
    let told = String::from_utf8_lossy(&refused.stderr);
    assert!(told.contains("--format html"), "{told}");
}

#[test]
fn a_page_of_a_configuration_starts_there() {
    let file = folder("mechanisms/planar_four_bar.urdf");
    let mechanism = read_file(&file, &[]).unwrap().mechanism;
    let Some(configuration) = mechanism.configurations().first() else {
        panic!("the file has no configuration");
    };
    let there = data(&page_of(&file, &["--at", &configuration.name]));
    let home = data(&page_of(&file, &[]));
    assert_ne!(there["home"], home["home"]);
}

/// A text without the tags in it.
fn bare(html: &str) -> String {
    html.split('<')
        .map(|piece| piece.split_once('>').map_or(piece, |(_, text)| text))
        .collect()
}

/// Whoever looks at a picture of a page reads what pages say today: `pages.json` holds what each said when it was taken.
#[test]
fn pictures_of_pages_are_not_old() {
    let path = folder("docs/src/images/pages.json");
    let taken: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let taken = taken.as_object().unwrap();
    let pictures = std::fs::read_dir(folder("docs/src/images")).unwrap();
    let pictures = pictures.filter_map(|entry| entry.unwrap().file_name().into_string().ok());
    let pictures = pictures.filter(|name| name.starts_with("page_")).count();
    assert_eq!(pictures, taken.len());
    for (picture, of) in taken {
        let page = page(of["page"].as_str().unwrap());
        let header = between(&page, "</h1>", "</header>");
        let sentence = bare(&format!("<p{}", between(header, "<p", "</p>")));
        assert_eq!(
            of["sentence"].as_str().unwrap(),
            sentence,
            "{picture} is old: bash .ci/pictures"
        );
    }
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn every_own_mechanism_has_a_page() {
        let to = scratch("gallery_of_all");
        let files = support::sample(support::mechanism_files(&folder("mechanisms")), 3);
        let run = support::program()
            .arg("gallery")
            .args(files.iter().map(|(_, file)| file))
            .arg("-o")
            .arg(&to)
            .output()
            .unwrap();
        assert!(
            run.status.success(),
            "{}",
            String::from_utf8_lossy(&run.stderr)
        );
        for (_, file) in files {
            let name = file.with_extension("html");
            let page = std::fs::read_to_string(to.join(name.file_name().unwrap())).unwrap();
            let data = data(&page);
            // Something moves, or it says why not.
            let moves = !data["motions"].as_array().unwrap().is_empty();
            let branches = data["branches"].as_array().unwrap();
            let said = data["still"].is_string() || branches.iter().any(|b| b["still"].is_string());
            assert!(moves || said, "{}", file.display());
            for none in ["\"NaN", " NaN", ",NaN", "\"inf\"", " inf ", ",inf"] {
                assert!(!page.contains(none), "{}: {none}", file.display());
            }
        }
    }
}

#[test]
fn a_point_asked_for_is_on_the_page_and_goes_with_its_link() {
    let file = folder("mechanisms/planar_four_bar.urdf");
    let page = page_of(
        &file,
        &["--curve", "coupler:1,0.5", "--curve", "rocker:20mm,0,5mm"],
    );
    let with = data(&page);
    let points = with["points"].as_array().unwrap();
    assert_eq!(points.len(), 2);
    assert_eq!(points[0]["at"], serde_json::json!([1.0, 0.5, 0.0]));
    assert_eq!(points[1]["at"], serde_json::json!([0.02, 0.0, 0.005]));
    // A ball each, fixed in the link that was named.
    let without = data(&self::page("planar_four_bar"));
    assert!(without.get("points").is_none());
    let shapes = |data: &Value| data["shapes"].as_array().unwrap().clone();
    let (all, plain) = (shapes(&with), shapes(&without));
    assert_eq!(all.len(), plain.len() + 2);
    for (ball, point) in all[plain.len()..].iter().zip(points) {
        assert_eq!(
            (&ball["link"], &ball["kind"]),
            (&point["link"], &"sphere".into())
        );
        let name = with["links"][point["link"].as_u64().unwrap() as usize]["name"].as_str();
        assert!(point["name"].as_str().unwrap().starts_with(name.unwrap()));
    }
    let text = kutzbach(&["report", file.to_str().unwrap(), "--curve", "coupler:1,0"]);
    assert_eq!(text.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&text.stderr).contains("--format html"));
}

#[test]
fn a_page_has_the_motors_and_the_first_lines_of_the_report() {
    let page = page("delta");
    let header = between(&page, "<header id=\"verdict\">", "</header>");
    assert!(
        header.contains("Sufficient: <code>motor_1</code>"),
        "{header}"
    );
    assert!(
        header.contains("<title>mobile, as the count predicts</title>"),
        "{header}"
    );
    let four_bar = self::page("planar_four_bar");
    assert!(four_bar.contains("<title>mobile, as the count predicts: a four-bar linkage</title>"));
    // What the answer hangs on stands first, and once.
    let text = std::fs::read_to_string(folder("mechanisms/planar_four_bar.urdf")).unwrap();
    let text = text.replace(
        "</robot>",
        "<mujoco><equality><tendon tendon1=\"t\"/></equality></mujoco></robot>",
    );
    let file = scratch("first_lines").join("odd.urdf");
    std::fs::write(&file, text).unwrap();
    let page = page_of(&file, &[]);
    let header = between(&page, "<header id=\"verdict\">", "</header>");
    let told = "it constrains the motion, and the answer is not about that";
    assert!(header.contains(told), "{header}");
    assert_eq!(page.matches(told).count(), 1);
}

#[test]
fn rods_that_carry_a_platform_are_not_idle_links() {
    let roles = |page: &str| {
        let data = data(page);
        let roles = data["motions"][0]["roles"]["links"].clone();
        let names = data["links"].as_array().unwrap().clone();
        let all = roles.as_array().unwrap().clone();
        let named = names
            .iter()
            .zip(all)
            .map(|(n, r)| (n["name"].to_string(), r));
        named.collect::<Vec<_>>()
    };
    // The rods of a delta spin besides; no link of it only spins.
    let delta = roles(&page("delta"));
    let moving = delta.iter().filter(|(name, _)| name.contains("rod"));
    assert!(
        moving.clone().count() == 6 && moving.clone().all(|(_, role)| role == "moving"),
        "{delta:?}"
    );
}
