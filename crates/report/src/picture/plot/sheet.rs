//! Several plots in one file.

use super::{Plot, STYLE};
use crate::picture::markup::{escaped, put, px};

/// Space between two plots (px).
const GAP: f64 = 18.0;

/// The plots below one another as a file of its own, for light and dark screens.
#[must_use]
pub fn sheet(plots: &[Plot]) -> String {
    if let [plot] = plots {
        return plot.document();
    }
    let sizes = plots.iter().map(|plot| super::Frame::new(plot).size);
    let (width, height) = sizes.clone().fold((0.0, 0.0), |(width, height), size| {
        (f64::max(width, size[0]), height + size[1] + GAP)
    });
    let spoken: Vec<String> = plots.iter().map(Plot::spoken).collect();
    let mut svg = String::new();
    put(
        &mut svg,
        format_args!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"img\" aria-label=\"{title}\">\n<title>{title}</title>\n<style>{STYLE}</style>\n<rect class=\"back\" width=\"100%\" height=\"100%\"/>\n",
            title = escaped(&spoken.join("; ")),
            w = px(width),
            h = px(height),
        ),
    );
    let mut top = 0.0;
    for (plot, size) in plots.iter().zip(sizes) {
        put(
            &mut svg,
            format_args!(
                "<g transform=\"translate(0 {})\"{}>\n",
                px(top),
                plot.scale_attributes()
            ),
        );
        plot.write_content(&mut svg);
        svg.push_str("</g>\n");
        top += size[1] + GAP;
    }
    svg.push_str("</svg>\n");
    svg
}
