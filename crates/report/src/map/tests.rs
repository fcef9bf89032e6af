use super::*;
use roxmltree::{Document, Node};

const HEAD: &str = r#"# {"schema":"kutzbach-sweep-1","program":"0.1.0","file":"four bar.urdf","hash":"00","over":["a=1..3:3","b=0..2:3"],"sample":null,"depth":"motions","shard":"1/1","variants":9,"set":["c=2"],"literal":false,"precision":null,"closure_tolerance":null}"#;

const COLUMNS: &str = "variant,a,b,status,kutzbach,instantaneous,redundant,margin,finite,generic,verdict,pose,kind,class,branches,locked,reason";

/// Three by three: it moves, locks, is singular, rigid, shaky, undecided, does not assemble, is none.
const ROWS: [&str; 9] = [
    "0,1,0,analysed,-2,1,3,3.20e2,1,0,mobile,regular,,trivial,1,,",
    "1,1,1,analysed,-2,1,3,7.40e1,1,0,mobile,regular,,trivial,1,A;B,",
    "2,1,2,analysed,-2,2,4,2.07e0,1,0,mobile,singular,bifurcation,,2,,",
    "3,2,0,analysed,-2,1,3,5.70e2,1,0,mobile,regular,,trivial,1,,",
    "4,2,1,analysed,-2,0,2,,0,0,rigid,regular,,,,,",
    "5,2,2,analysed,-2,1,3,2.00e2,0,0,rigid,singular,shaky,,0,,",
    "6,3,0,analysed,-2,1,3,1.00e1,,0,undecided,,,,,,\"no engine, alone, decides\"",
    "7,3,1,unassembled,-2,,,,,,unassembled,,,,,,a loop misses by <0.5>",
    "8,3,2,invalid,,,,,,,,,,,,,division by zero",
];

fn csv(head: &str, rows: &[&str]) -> String {
    let mut lines = vec![head, COLUMNS];
    lines.extend(rows);
    lines.retain(|line| !line.is_empty());
    lines.join("\n") + "\n"
}

fn read(asked: MapAsked, files: &[&str]) -> Result<Map, MapError> {
    let mut reader = MapReader::new(asked);
    for file in files {
        reader.read("out.csv", file.as_bytes())?;
    }
    reader.finish()
}

fn map(colour: Option<&str>, files: &[&str]) -> Map {
    let asked = MapAsked {
        colour: colour.map(str::to_owned),
        ..MapAsked::default()
    };
    read(asked, files).unwrap()
}

fn legend(map: &Map) -> Vec<(&str, usize)> {
    map.legend().collect()
}

fn with_class<'a>(document: &'a Document<'a>, class: &str) -> Vec<Node<'a, 'a>> {
    let has = |node: &Node<'_, '_>| {
        node.attribute("class")
            .is_some_and(|own| own.split(' ').any(|one| one == class))
    };
    document.descendants().filter(has).collect()
}

/// The shapes of a map with what is told of each.
fn shapes<'a>(document: &'a Document<'a>) -> Vec<(String, String)> {
    let cells = with_class(document, "cell");
    let shown = cells.into_iter().filter(|node| !node.has_tag_name("rect"));
    shown
        .map(|node| {
            let class = node.attribute("class").unwrap().to_owned();
            let title = node.first_element_child().unwrap();
            (class, title.text().unwrap().to_owned())
        })
        .collect()
}

#[test]
fn a_map_is_what_its_reader_expects() {
    let svg = map(None, &[&csv(HEAD, &ROWS)]).document();
    // The style has its own file.
    let (head, rest) = svg.split_once("<style>").unwrap();
    let (_, picture) = rest.split_once("</style>\n").unwrap();
    insta::assert_snapshot!(format!("{head}{picture}"));
}

#[test]
fn rows_become_cells_with_their_answers() {
    let map = map(None, &[&csv(HEAD, &ROWS)]);
    assert!(map.is_grid() && map.notes().is_empty(), "{:?}", map.notes());
    assert_eq!(map.title(), "four bar.urdf: how it moves over a and b");
    assert_eq!(
        legend(&map),
        [
            ("mobile, 1 DOF", 2),
            ("mobile, 1 DOF, locked joints", 1),
            ("mobile, 1 DOF, singular", 1),
            ("rigid", 1),
            ("rigid, singular", 1),
            ("undecided", 1),
            ("unassembled", 1),
            ("invalid", 1),
        ]
    );
    let svg = map.document();
    let document = Document::parse(&svg).unwrap();
    let shapes = shapes(&document);
    assert_eq!(shapes.len(), 9);
    // Row by row from the least `b`.
    let classes: Vec<&str> = shapes.iter().map(|(class, _)| class.as_str()).collect();
    assert_eq!(
        classes,
        [
            "cell moves1",
            "cell moves1",
            "cell undecided",
            "cell locks1",
            "cell rigid",
            "cell unassembled",
            "cell singular1",
            "cell shaky",
            "cell invalid",
        ]
    );
    assert_eq!(shapes[0].1, "a = 1, b = 0\nmobile, 1 DOF\nvariant 0");
    assert_eq!(
        shapes[2].1,
        "a = 3, b = 0\nundecided\nno engine, alone, decides\nvariant 6"
    );
    assert!(shapes[5].1.contains("a loop misses by <0.5>"));
}

#[test]
fn the_border_runs_where_the_answer_changes() {
    let map = map(None, &[&csv(HEAD, &ROWS)]);
    let lines = map.border();
    use grid::Line::{Level, Upright};
    // Locked joints and singular poses are no other answer; what is rigid, undecided or without answer is.
    assert!(
        lines.contains(&Upright {
            column: 1,
            from: 1,
            to: 3
        }),
        "{lines:?}"
    );
    assert!(
        lines.contains(&Upright {
            column: 2,
            from: 0,
            to: 3
        }),
        "{lines:?}"
    );
    assert!(
        lines.contains(&Level {
            row: 1,
            from: 1,
            to: 3
        }),
        "{lines:?}"
    );
    assert!(
        lines.contains(&Level {
            row: 2,
            from: 2,
            to: 3
        }),
        "{lines:?}"
    );
    assert_eq!(lines.len(), 4, "{lines:?}");
}

#[test]
fn the_margin_has_a_logarithmic_scale() {
    let map = map(Some("margin"), &[&csv(HEAD, &ROWS)]);
    // From 2.07 to 570: three decades of three steps.
    assert_eq!(
        legend(&map),
        [
            ("1 … 2", 0),
            ("2 … 5", 1),
            ("5 … 10", 0),
            ("10 … 20", 1),
            ("20 … 50", 0),
            ("50 … 100", 1),
            ("100 … 200", 0),
            ("200 … 500", 2),
            ("500 … 1000", 1),
            ("unassembled", 1),
            ("invalid", 1),
            ("no other rank is near", 1),
        ]
    );
    assert!(map.notes()[0].starts_with("The margin is"));
    let svg = map.document();
    let document = Document::parse(&svg).unwrap();
    assert_eq!(shapes(&document)[6].0, "cell step1");
    assert!(shapes(&document)[6].1.contains("margin 2.07e0"));
    assert_eq!(with_class(&document, "note").len(), 3);
}

#[test]
fn columns_of_words_and_counts_have_colours() {
    let classes = map(Some("class"), &[&csv(HEAD, &ROWS)]);
    assert_eq!(
        legend(&classes),
        [
            ("trivial", 3),
            ("unassembled", 1),
            ("invalid", 1),
            ("nothing to say", 4),
        ]
    );
    let counts = map(Some("finite"), &[&csv(HEAD, &ROWS)]);
    assert_eq!(legend(&counts)[..2], [("0", 2), ("1", 4)]);
    let asked = MapAsked {
        colour: Some("colour".to_owned()),
        ..MapAsked::default()
    };
    let error = read(asked, &[&csv(HEAD, &ROWS)]).unwrap_err();
    assert!(error.message.contains("`colour`"), "{error}");
    assert!(error.help.contains("`margin`"), "{}", error.help);
}

#[test]
fn shares_are_the_whole_in_any_order() {
    let whole = map(None, &[&csv(HEAD, &ROWS)]).document();
    let shares = [1, 2].map(|number| {
        let rows: Vec<&str> = ROWS.iter().skip(number - 1).step_by(2).copied().collect();
        csv(&HEAD.replace("1/1", &format!("{number}/2")), &rows)
    });
    let [one, two] = [&shares[0], &shares[1]].map(String::as_str);
    assert_eq!(map(None, &[one, two]).document(), whole);
    assert_eq!(map(None, &[two, one]).document(), whole);
    let half = map(None, &[two]);
    assert!(half.is_grid());
    assert_eq!(half.notes()[0], "4 of 9 variants are there.");
    let other = csv(&HEAD.replace("\"00\"", "\"01\""), &ROWS);
    let error = read(MapAsked::default(), &[one, &other]).unwrap_err();
    assert!(error.message.contains("another sweep"), "{error}");
}

#[test]
fn rows_of_one_cell_are_combined_and_that_is_said() {
    let columns = "variant,a,b,c,status,kutzbach,instantaneous,redundant,margin,reason";
    let rows = [
        "0,0,0,1,analysed,-2,1,3,5.00e1,",
        "1,0,0,2,analysed,-2,1,3,3.00e0,",
        "2,0,1,1,analysed,-2,1,3,5.00e1,",
        "3,0,1,2,analysed,-2,0,3,7.00e1,",
    ];
    let text = format!("{columns}\n{}\n", rows.join("\n"));
    let answers = map(None, &[&text]);
    assert_eq!(answers.count(), 2);
    assert_eq!(
        legend(&answers),
        [("1 DOF at this pose", 1), ("rows differ", 1)]
    );
    assert_eq!(
        answers.notes(),
        [
            "Up to 2 rows are one cell, since c varies too: it shows what all of them say, or that they differ."
        ]
    );
    let margins = map(Some("margin"), &[&text]);
    assert!(margins.notes()[0].ends_with("the least of their values."));
    let svg = margins.document();
    let document = Document::parse(&svg).unwrap();
    assert_eq!(
        shapes(&document)[0].1,
        "a = 0, b = 0\n2 \u{d7} 1 DOF at this pose\nleast margin 3\nfirst variant 0"
    );
    // Other axes: what does not vary is told.
    let asked = MapAsked {
        x: Some("c".to_owned()),
        y: Some("b".to_owned()),
        colour: None,
    };
    let other = read(asked, &[&text]).unwrap();
    assert_eq!(other.notes(), ["Throughout: a = 0."]);
    assert_eq!(other.count(), 4);
}

#[test]
fn samples_are_points() {
    let rows = [
        "0,0.5,0.25",
        "1,0.75,0.5",
        "2,pi/4,1/3",
        "3,0.125,1",
        "4,1,0.1",
    ]
    .map(|at| format!("{at},analysed,-2,1,3,5.00e1,1,0,mobile,regular,,trivial,1,,"));
    let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
    let head = HEAD.replace("\"sample\":null", "\"sample\":\"sobol:5\"");
    let map = map(None, &[&csv(&head, &rows)]);
    assert!(!map.is_grid() && map.border().is_empty());
    let svg = map.document();
    let document = Document::parse(&svg).unwrap();
    assert_eq!(with_class(&document, "dot").len(), 5);
    assert!(with_class(&document, "border").is_empty());
    assert!(svg.contains("a = pi/4, b = 1/3"));
}

#[test]
fn cells_of_a_large_grid_are_joined() {
    let mut text = COLUMNS.to_owned() + "\n";
    for variant in 0..22_500 {
        let (a, b) = (variant / 150, variant % 150);
        let verdict = match a < 75 {
            true => "1,0,mobile,regular,,trivial,1,,",
            false => "0,0,rigid,regular,,,,,",
        };
        text += &format!("{variant},{a},{b},analysed,-2,1,3,5.00e1,{verdict}\n");
    }
    let map = map(None, &[&text]);
    let svg = map.document();
    let document = Document::parse(&svg).unwrap();
    let shapes = shapes(&document);
    assert_eq!(shapes.len(), 300);
    assert_eq!(shapes[0].1, "a = 0 … 74, b = 0: mobile, 1 DOF");
    assert_eq!(map.border().len(), 1);
    assert!(map.listed().is_empty());
    assert!(map.notes()[0].starts_with("Cells of one colour"));
}

#[test]
fn each_cell_has_the_command_of_its_report() {
    let listed = map(None, &[&csv(HEAD, &ROWS)]).listed();
    assert_eq!(listed.len(), 9);
    assert_eq!(
        listed[1].command,
        "kutzbach report 'four bar.urdf' --set c=2 --set a=1 --set b=1"
    );
    assert_eq!(listed[1].shown, "mobile, 1 DOF, locked joints");
    let fragment = map(None, &[&csv(HEAD, &ROWS)]).fragment();
    let document = Document::parse(&fragment).unwrap();
    let leads = |node: &Node<'_, '_>| node.attribute("href") == Some("#variant-1");
    assert!(document.descendants().any(|node| leads(&node)));
    assert!(fragment.contains(&crate::picture::markup::escaped(&listed[1].command)));
    // Without the first line, nobody knows the file.
    let headless = map(None, &[&csv("", &ROWS)]).listed();
    assert_eq!(
        headless[0].command,
        "kutzbach report FILE --set a=1 --set b=0"
    );
}

#[test]
fn a_row_that_was_cut_off_is_left_out() {
    let mut text = csv(HEAD, &ROWS[..4]);
    text += "4,2,1,analysed,-2";
    let map = map(None, &[&text]);
    assert_eq!(map.count(), 4);
    assert_eq!(
        map.notes(),
        [
            "4 of 9 variants are there.",
            "Without a row, and left empty: 2 places.",
            "Cut off, and left out: 1 row.",
        ]
    );
}

#[test]
fn places_between_cells_are_dots() {
    let more = [
        "9,1.5,1,analysed,-2,1,3,5.70e2,1,0,mobile,regular,,trivial,1,,",
        "10,1.75,1,analysed,-2,2,2,5.70e2,2,0,mobile,regular,,trivial,1,,",
    ];
    let map = map(None, &[&csv(HEAD, &[&ROWS[..], &more].concat())]);
    assert!(map.is_grid());
    assert_eq!(map.count(), 9);
    assert_eq!(
        map.notes(),
        ["The border was looked for between cells: 2 places, as dots."]
    );
    let legend = legend(&map);
    assert_eq!(legend[0], ("mobile, 1 DOF", 2));
    assert!(legend.contains(&("mobile, 2 DOF", 0)));
    let svg = map.document();
    let document = Document::parse(&svg).unwrap();
    let dots = with_class(&document, "dot");
    assert_eq!(dots.len(), 2);
    assert_eq!(dots[1].attribute("class"), Some("cell dot moves2"));
    assert_eq!(map.listed().len(), 11);
}

#[test]
fn what_is_no_sweep_is_refused() {
    let whole = csv(HEAD, &ROWS);
    let broken = csv(HEAD, &["0,1,0,analysed", ROWS[1]]);
    let unknown = csv(HEAD, &[&ROWS[0].replace("analysed", "analyzed")]);
    let no_number = csv(HEAD, &[&ROWS[0].replace("0,1,0", "0,long,0")]);
    let no_rows = csv(HEAD, &[]);
    let other_schema = whole.replace("kutzbach-sweep-1", "kutzbach-sweep-9");
    for (text, said) in [
        ("", "the names of its columns"),
        ("a,b\n1,2\n", "the names of its columns"),
        ("{\"schema\":\"kutzbach-sweep-1\"}\n", "lines of JSON"),
        ("# {\n", "as JSON"),
        (no_rows.as_str(), "no row"),
        (broken.as_str(), "line 3"),
        (unknown.as_str(), "status"),
        (no_number.as_str(), "`long` of `a`"),
        (other_schema.as_str(), "kutzbach-sweep-9"),
        ("variant,a,status,reason\n0,1,analysed,\n", "two measures"),
    ] {
        let error = read(MapAsked::default(), &[text]).unwrap_err();
        assert!(error.message.contains(said), "{said}: {error}");
        assert!(!error.help.is_empty());
    }
    let same = MapAsked {
        x: Some("a".to_owned()),
        y: Some("a".to_owned()),
        colour: None,
    };
    assert!(read(same, &[&whole]).is_err());
    let unknown = MapAsked {
        x: Some("q".to_owned()),
        ..MapAsked::default()
    };
    let error = read(unknown, &[&whole]).unwrap_err();
    assert_eq!(error.help, "it has `a`, `b`");
}

#[test]
fn names_are_text_and_columns_of_measures_are_known() {
    let text = csv("", &ROWS).replace("variant,a,b,", "variant,pose (measure),\"<b>,\"\"x\",");
    let asked = MapAsked {
        x: Some("pose".to_owned()),
        ..MapAsked::default()
    };
    let map = read(asked, &[&text]).unwrap();
    assert_eq!(map.title(), "how it moves over pose and <b>,\"x");
    for svg in [map.document(), map.fragment()] {
        let document = Document::parse(&svg).unwrap();
        assert!(!document.descendants().any(|node| node.has_tag_name("b")));
    }
    assert!(!map.fragment().contains("style"));
}

#[test]
fn one_value_and_far_values_are_drawn() {
    for rows in [
        vec!["0,0,0"],
        vec!["0,1e300,-1e300", "1,-1e300,1e300"],
        vec!["0,1,1", "1,1.0000000000000002,1"],
    ] {
        let rows: Vec<String> = rows
            .iter()
            .map(|at| format!("{at},analysed,-2,1,3,5.00e1,1,0,mobile,regular,,trivial,1,,"))
            .collect();
        let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
        let svg = map(None, &[&csv("", &rows)]).document();
        assert!(Document::parse(&svg).is_ok());
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }
}
