//! The names of measures that a text defines.

/// Names of the properties and arguments that a text defines itself, in its order, each once: those that [`ReadOptions::symbolic`](crate::ReadOptions::symbolic) can name, without those of
/// files that it includes. None of a text that is no XML.
#[must_use]
pub fn property_names(text: &str) -> Vec<String> {
    let Ok(document) = roxmltree::Document::parse(text) else {
        return Vec::new();
    };
    let defines = |node: &roxmltree::Node<'_, '_>| {
        matches!(node.tag_name().name(), "property" | "arg")
            && node.tag_name().namespace().is_some()
    };
    let mut names: Vec<String> = Vec::new();
    for node in document.descendants().filter(defines) {
        if let Some(name) = node
            .attribute("name")
            .filter(|n| !names.iter().any(|own| own == n))
        {
            names.push(name.to_owned());
        }
    }
    names
}
