//! Solids as SVG.

use super::order::back_to_front;
use super::scene::{Item, Scene};
use super::solid::{Solid, faces};
use super::{Detail, Sketch};
use crate::picture::markup::{escaped, put, px};
use crate::picture::vector::{Vector, difference, dot, norm, unit};
use kutzbach_scene::{Colour, GAP, Part};

/// Where light comes from: from the upper left, and from the eye (right, down, towards the eye).
const LIGHT: Vector = [-0.45, -0.65, 0.61];

/// The whole picture.
pub fn write(
    sketch: &Sketch<'_>,
    scene: &Scene,
    detail: Detail,
    namespace: &str,
    style: &str,
) -> String {
    let mut svg = String::new();
    let name = escaped(sketch.mechanism.name());
    put(
        &mut svg,
        format_args!(
            concat!(
                "<svg{namespace} class=\"sketch\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"img\" ",
                "aria-label=\"{name}\" fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n{style}"
            ),
            namespace = namespace,
            w = px(scene.size[0]),
            h = px(scene.size[1]),
            name = name,
            style = style
        ),
    );
    for ghost in &scene.ghosts {
        svg.push_str("<g class=\"ghost\" opacity=\"0.22\">");
        write_lines(&mut svg, ghost);
        svg.push_str("</g>\n");
    }
    for (colour, points) in &scene.paths {
        write_path(&mut svg, *colour, points);
    }
    if detail == Detail::Lines {
        write_lines(&mut svg, &scene.items);
    } else {
        let order = back_to_front(sketch.mechanism, &scene.items);
        let items: Vec<&Item> = order.iter().map(|&i| &scene.items[i]).collect();
        let together = |a: &&Item, b: &&Item| owner(a) == owner(b);
        let mut webs = scene.webs.clone();
        for group in items.chunk_by(together) {
            // The body lies below the first of its rods.
            let web = match group[0].part {
                Part::Link => webs.remove(&group[0].link),
                _ => None,
            };
            write_group(&mut svg, sketch, group, web, detail);
        }
    }
    for [a, b] in &scene.gaps {
        put(
            &mut svg,
            format_args!(
                "<path class=\"gap\" d=\"M{} {}L{} {}\" stroke=\"{}\" stroke-width=\"2\" stroke-dasharray=\"1 4\"/>\n",
                px(a[0]),
                px(a[1]),
                px(b[0]),
                px(b[1]),
                hex(GAP)
            ),
        );
    }
    svg.push_str("</svg>\n");
    svg
}

/// Items of one owner become one element.
fn owner(item: &Item) -> (bool, usize, bool) {
    match item.part {
        Part::Link => (true, item.link, false),
        Part::Joint(joint) => (false, joint, false),
        Part::Axis(joint) => (false, joint, true),
    }
}

fn write_group(
    svg: &mut String,
    sketch: &Sketch<'_>,
    group: &[&Item],
    web: Option<Vec<[f64; 2]>>,
    detail: Detail,
) {
    let Some(first) = group.first() else {
        return;
    };
    let mechanism = sketch.mechanism;
    let (attributes, name) = match first.part {
        Part::Link => {
            let ground = if first.link == mechanism.ground().0 {
                " class=\"ground\""
            } else {
                ""
            };
            let name = mechanism.links().get(first.link).map(|link| &link.name);
            (format!("{ground} data-link=\"{}\"", first.link), name)
        }
        Part::Joint(joint) | Part::Axis(joint) => {
            let axis = matches!(first.part, Part::Axis(_));
            let class = if axis { " class=\"axis\"" } else { "" };
            let name = mechanism.joints().get(joint).map(|joint| &joint.name);
            (format!("{class} data-joint=\"{joint}\""), name)
        }
    };
    put(svg, format_args!("<g{attributes}>"));
    if let (Some(name), true) = (name, detail <= Detail::Plain) {
        put(svg, format_args!("<title>{}</title>", escaped(name)));
    }
    if let Some(web) = web {
        let points: Vec<String> = web
            .iter()
            .map(|p| format!("{} {}", px(p[0]), px(p[1])))
            .collect();
        put(
            svg,
            format_args!(
                "<path class=\"web\" d=\"M{}Z\" fill=\"{}\" fill-opacity=\"0.24\"/>",
                points.join("L"),
                hex(first.colour)
            ),
        );
    }
    // Rods next to each other are one figure, so that no outline runs across their corners.
    let rods = |a: &&Item, b: &&Item| matches!((a.solid, b.solid), (Solid::Rod { radius: r, .. }, Solid::Rod { radius: s, .. }) if r == s);
    for run in group.chunk_by(rods) {
        let item = run[0];
        match item.solid {
            Solid::Rod { radius, .. } => write_rods(svg, run, radius, detail),
            Solid::Ball { centre, radius } => write_ball(svg, item.colour, centre, radius, detail),
            Solid::Cylinder { ends, radius } => write_cylinder(svg, item.colour, ends, radius),
            Solid::Cuboid { centre, halves } => write_cuboid(svg, item.colour, centre, halves),
            Solid::Line { ends: [a, b] } => put(
                svg,
                format_args!(
                    "<path d=\"M{} {}L{} {}\" stroke=\"{}\" stroke-width=\"1\" stroke-dasharray=\"7 2.5 1 2.5\"/>",
                    px(a[0]),
                    px(a[1]),
                    px(b[0]),
                    px(b[1]),
                    hex(item.colour)
                ),
            ),
        }
    }
    svg.push_str("</g>\n");
}

/// Thickness of a rod on the page.
fn thickness(radius: f64) -> f64 {
    (2.0 * radius).max(1.6)
}

/// Thickness of outlines about something of that radius.
fn outline(radius: f64) -> f64 {
    (0.28 * radius).clamp(0.45, 1.1)
}

fn write_rods(svg: &mut String, rods: &[&Item], radius: f64, detail: Detail) {
    let mut d = String::new();
    let mut pen: Option<[String; 2]> = None;
    for item in rods {
        let Solid::Rod { ends, .. } = item.solid else {
            continue;
        };
        let [mut from, mut to] = ends.map(|p| [px(p[0]), px(p[1])]);
        if pen.as_ref() == Some(&to) {
            std::mem::swap(&mut from, &mut to);
        }
        if pen.as_ref() != Some(&from) {
            put(&mut d, format_args!("M{} {}", from[0], from[1]));
        }
        put(&mut d, format_args!("L{} {}", to[0], to[1]));
        pen = Some(to);
    }
    let colour = rods[0].colour;
    let width = thickness(radius);
    if detail < Detail::Dots {
        put(
            svg,
            format_args!(
                "<path d=\"{d}\" stroke=\"{}\" stroke-width=\"{}\"/>",
                hex(shaded(colour, EDGE)),
                px(width + 2.0 * outline(radius))
            ),
        );
    }
    put(
        svg,
        format_args!(
            "<path d=\"{d}\" stroke=\"{}\" stroke-width=\"{}\"/>",
            hex(colour),
            px(width)
        ),
    );
    if detail == Detail::Full && width > 4.0 {
        let aside = px(-0.14 * width);
        put(
            svg,
            format_args!(
                "<path d=\"{d}\" transform=\"translate({aside} {aside})\" stroke=\"{}\" stroke-width=\"{}\"/>",
                hex(shaded(colour, 1.3)),
                px(0.3 * width)
            ),
        );
    }
}

fn write_ball(svg: &mut String, colour: Colour, centre: Vector, radius: f64, detail: Detail) {
    let [x, y, _] = centre;
    if detail >= Detail::Dots {
        put(
            svg,
            format_args!(
                "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"/>",
                px(x),
                px(y),
                px(radius.max(0.8)),
                hex(colour)
            ),
        );
        return;
    }
    put(
        svg,
        format_args!(
            "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"{}\"/>",
            px(x),
            px(y),
            px(radius.max(0.8)),
            hex(colour),
            hex(shaded(colour, EDGE)),
            px(outline(radius))
        ),
    );
    if detail == Detail::Full && radius > 2.5 {
        put(
            svg,
            format_args!(
                "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"#fff\" fill-opacity=\"0.5\"/>",
                px(x - 0.32 * radius),
                px(y - 0.36 * radius),
                px(0.3 * radius)
            ),
        );
    }
}

/// A cylinder with flat ends: its mantle, and the end that is seen.
fn write_cylinder(svg: &mut String, colour: Colour, ends: [Vector; 2], radius: f64) {
    let [far, near] = if ends[0][2] <= ends[1][2] {
        ends
    } else {
        [ends[1], ends[0]]
    };
    let way = difference(near, far);
    let length = norm(way);
    let edge = format!(
        "stroke=\"{}\" stroke-width=\"{}\"",
        hex(shaded(colour, EDGE)),
        px(outline(radius))
    );
    let r = radius.max(0.5);
    let flat = way[0].hypot(way[1]);
    let toward = if length > 0.0 { way[2] / length } else { 1.0 };
    let cap = shaded(colour, lit([way[0], way[1], way[2]], length));
    if !(flat > 0.02 * length) {
        put(
            svg,
            format_args!(
                "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\" {edge}/>",
                px(near[0]),
                px(near[1]),
                px(r),
                hex(cap)
            ),
        );
        return;
    }
    // Across the axis, on the page.
    let (ux, uy) = (way[0] / flat, way[1] / flat);
    let (nx, ny) = (-uy * r, ux * r);
    let minor = px(r * toward);
    let turn = px(uy.atan2(ux).to_degrees());
    let at = |p: Vector, sign: f64| format!("{} {}", px(p[0] + sign * nx), px(p[1] + sign * ny));
    let mantle = shaded(
        colour,
        lit([nx, ny, 0.0], r).max(lit([-nx, -ny, 0.0], r)).min(1.0) * 0.86,
    );
    let major = px(r);
    put(
        svg,
        format_args!(
            "<path d=\"M{}L{}A{minor} {major} {turn} 0 1 {}L{}A{minor} {major} {turn} 0 1 {}Z\" fill=\"{}\" {edge}/>",
            at(near, 1.0),
            at(far, 1.0),
            at(far, -1.0),
            at(near, -1.0),
            at(near, 1.0),
            hex(mantle)
        ),
    );
    if toward * r > 0.4 {
        put(
            svg,
            format_args!(
                "<path d=\"M{}A{minor} {major} {turn} 1 1 {}A{minor} {major} {turn} 1 1 {}Z\" fill=\"{}\" {edge}/>",
                at(near, 1.0),
                at(near, -1.0),
                at(near, 1.0),
                hex(cap)
            ),
        );
    }
}

fn write_cuboid(svg: &mut String, colour: Colour, centre: Vector, halves: [Vector; 3]) {
    let size = halves
        .iter()
        .map(|h| norm(*h))
        .fold(f64::INFINITY, f64::min);
    put(
        svg,
        format_args!(
            "<g stroke=\"{}\" stroke-width=\"{}\">",
            hex(shaded(colour, EDGE)),
            px(outline(size))
        ),
    );
    for (corners, normal) in faces(centre, halves) {
        let points: Vec<String> = corners
            .iter()
            .map(|p| format!("{} {}", px(p[0]), px(p[1])))
            .collect();
        put(
            svg,
            format_args!(
                "<path d=\"M{}Z\" fill=\"{}\"/>",
                points.join("L"),
                hex(shaded(colour, lit(normal, 1.0)))
            ),
        );
    }
    svg.push_str("</g>");
}

/// Solids as plain lines and dots, one path for each colour and thickness.
fn write_lines(svg: &mut String, items: &[Item]) {
    let mut figures: Vec<(String, String)> = Vec::new();
    let mut add = |attributes: String, d: String| match figures
        .iter_mut()
        .find(|(known, _)| *known == attributes)
    {
        Some((_, path)) => path.push_str(&d),
        None => figures.push((attributes, d)),
    };
    for item in items {
        let colour = hex(item.colour);
        match item.solid {
            Solid::Rod { ends, radius } | Solid::Cylinder { ends, radius } => {
                let [a, b] = ends;
                add(
                    format!(
                        "stroke=\"{colour}\" stroke-width=\"{}\"",
                        px(thickness(radius))
                    ),
                    format!("M{} {}L{} {}", px(a[0]), px(a[1]), px(b[0]), px(b[1])),
                );
            }
            Solid::Ball { centre, radius } => add(
                format!(
                    "stroke=\"{colour}\" stroke-width=\"{}\"",
                    px(thickness(radius))
                ),
                format!("M{} {}h0", px(centre[0]), px(centre[1])),
            ),
            Solid::Cuboid { centre, halves } => {
                for (corners, _) in faces(centre, halves) {
                    let points: Vec<String> = corners
                        .iter()
                        .map(|p| format!("{} {}", px(p[0]), px(p[1])))
                        .collect();
                    add(
                        format!("fill=\"{colour}\""),
                        format!("M{}Z", points.join("L")),
                    );
                }
            }
            Solid::Line { .. } => {}
        }
    }
    for (attributes, d) in figures {
        put(svg, format_args!("<path {attributes} d=\"{d}\"/>"));
    }
}

fn write_path(svg: &mut String, colour: Colour, points: &[[f64; 2]]) {
    if points.len() < 2 {
        return;
    }
    let mut d = String::from("M");
    let mut last = String::new();
    for point in points {
        let text = format!("{} {}", px(point[0]), px(point[1]));
        if text != last {
            if !last.is_empty() {
                d.push('L');
            }
            d.push_str(&text);
            last = text;
        }
    }
    put(
        svg,
        format_args!(
            "<path class=\"path\" d=\"{d}\" stroke=\"{}\" stroke-width=\"1.4\" stroke-dasharray=\"0.1 3.5\"/>\n",
            hex(colour)
        ),
    );
}

/// Brightness of outlines.
const EDGE: f64 = 0.5;

/// How bright a face with a given normal is; 1 leaves the colour as it is.
fn lit(normal: Vector, length: f64) -> f64 {
    let light = unit(LIGHT).unwrap_or(LIGHT);
    if length > 0.0 {
        0.8 + 0.4 * (dot(normal, light) / length).clamp(-0.5, 1.0)
    } else {
        1.0
    }
}

/// A colour made darker (below 1) or lighter (above 1).
fn shaded(colour: Colour, brightness: f64) -> Colour {
    let component = |x: f64| {
        if brightness <= 1.0 {
            x * brightness
        } else {
            x + (1.0 - x) * (brightness - 1.0).min(1.0)
        }
    };
    Colour {
        red: component(colour.red),
        green: component(colour.green),
        blue: component(colour.blue),
        opacity: colour.opacity,
    }
}

fn hex(colour: Colour) -> String {
    let byte = |x: f64| (255.0 * x.clamp(0.0, 1.0)).round() as u8;
    format!(
        "#{:02x}{:02x}{:02x}",
        byte(colour.red),
        byte(colour.green),
        byte(colour.blue)
    )
}
