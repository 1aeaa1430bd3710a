//! `sphpack view`: a page holds what the file holds, and asks for nothing else.

use std::collections::BTreeMap;

use serde_json::Value;
use sphpack::files::{Columns, PARTICLE_FORMATS};

use crate::{CYLINDER, Desk};

/// Bodies whose names would end an element, or a text, in a page that took them as they are.
const AWKWARD: [&str; 4] = [
    "</script><script>alert(1)</script>",
    "a \"quoted\" <b>name</b>",
    "<!-- & <script>",
    "",
];

/// Bytes of letters (RFC 4648), by other code than that which writes them.
fn decoded(text: &str) -> Vec<u8> {
    let value = |letter: u8| match letter {
        b'A'..=b'Z' => letter - b'A',
        b'a'..=b'z' => letter - b'a' + 26,
        b'0'..=b'9' => letter - b'0' + 52,
        b'+' => 62,
        b'/' => 63,
        other => panic!("{} is no letter of base64", char::from(other)),
    };
    let mut bytes = Vec::new();
    let (mut bits, mut count) = (0_u32, 0);
    for letter in text.bytes().filter(|&letter| letter != b'=') {
        bits = bits << 6 | u32::from(value(letter));
        count += 6;
        if count >= 8 {
            count -= 8;
            bytes.push((bits >> count & 255) as u8);
        }
    }
    bytes
}

/// What a page holds.
struct Page {
    text: String,
    about: Value,
}

impl Page {
    fn read(desk: &Desk, name: &str) -> Self {
        let text = String::from_utf8(desk.read(name)).expect("text");
        let about = element(&text, "about");
        let about = serde_json::from_str(about).expect("JSON");
        Self { text, about }
    }

    fn rows(&self) -> usize {
        self.about["rows"].as_u64().expect("a number") as usize
    }

    /// The stored numbers of an element.
    fn stored(&self, id: &str, store: &str) -> Vec<f64> {
        let bytes = decoded(element(&self.text, id));
        fn of<const N: usize>(bytes: &[u8], read: impl Fn([u8; N]) -> f64) -> Vec<f64> {
            let (whole, rest) = bytes.as_chunks::<N>();
            assert!(rest.is_empty(), "a piece of a number");
            whole.iter().map(|&piece| read(piece)).collect()
        }
        match store {
            "none" => vec![0.0; self.rows()],
            "u8" => of(&bytes, |b: [u8; 1]| f64::from(b[0])),
            "u16" => of(&bytes, |b| f64::from(u16::from_le_bytes(b))),
            "u32" => of(&bytes, |b| f64::from(u32::from_le_bytes(b))),
            "f32" => of(&bytes, |b| f64::from(f32::from_le_bytes(b))),
            "f64" => of(&bytes, f64::from_le_bytes),
            other => panic!("no store is called {other}"),
        }
    }

    /// Every column, coordinates too.
    fn columns(&self) -> Columns {
        let mut columns = Columns::default();
        for (number, told) in self.about["columns"]
            .as_array()
            .expect("a list")
            .iter()
            .enumerate()
        {
            let name = told["name"].as_str().expect("a name").to_owned();
            let store = told["store"].as_str().expect("a store");
            let stored = self.stored(&format!("column-{number}"), store);
            assert_eq!(stored.len(), self.rows(), "{name}");
            if let Some(words) = told["words"].as_array() {
                let word =
                    |&place: &f64| words[place as usize].as_str().expect("a word").to_owned();
                columns
                    .words
                    .insert(name, stored.iter().map(word).collect());
            } else if let Some(table) = told["table"].as_array() {
                // What is not a number is null in JSON.
                let number = |&place: &f64| table[place as usize].as_f64().unwrap_or(f64::NAN);
                columns
                    .numbers
                    .insert(name, stored.iter().map(number).collect());
            } else {
                columns.numbers.insert(name, stored);
            }
        }
        let dimension = self.about["dimension"].as_u64().expect("a number") as usize;
        let places = self.stored("position", "f32");
        assert_eq!(places.len(), dimension * self.rows());
        for (k, name) in ["x", "y", "z"].into_iter().enumerate().take(dimension) {
            let middle = self.about["middle"][k].as_f64().expect("a number");
            let along = places.chunks(dimension).map(|place| middle + place[k]);
            columns.numbers.insert(name.to_owned(), along.collect());
        }
        columns
    }

    /// That every row is there, in its order: words and whole numbers as they are, others to so much of the box or themselves.
    #[track_caller]
    fn holds(&self, file: &Columns) {
        let mut found = self.columns();
        assert_eq!(found.words, file.words);
        let size = (0..3)
            .map(|k| {
                self.about["max"][k].as_f64().unwrap() - self.about["min"][k].as_f64().unwrap()
            })
            .fold(0.0, f64::max);
        let mut numbers: BTreeMap<&String, &Vec<f64>> = file.numbers.iter().collect();
        if self.about["dimension"] == 2 {
            numbers.retain(|name, _| *name != "z");
        }
        for (name, numbers) in numbers {
            let found = found
                .numbers
                .remove(name)
                .unwrap_or_else(|| panic!("no column {name}"));
            assert_eq!(found.len(), numbers.len());
            for (row, (&is, &expected)) in found.iter().zip(numbers).enumerate() {
                let near = match name.as_str() {
                    "x" | "y" | "z" => 1e-7 * size,
                    _ => 1e-6 * expected.abs(),
                };
                let is_same = is.is_nan() && expected.is_nan() || is == expected;
                assert!(
                    is_same || (is - expected).abs() <= near,
                    "{name} of row {row}: {is}, not {expected}"
                );
            }
        }
        assert_eq!(
            found.numbers.keys().collect::<Vec<_>>(),
            Vec::<&String>::new()
        );
    }
}

/// What is in the element of a name.
fn element<'a>(page: &'a str, id: &str) -> &'a str {
    let begin = format!("id=\"{id}\">");
    let (_, rest) = page
        .split_once(&begin)
        .unwrap_or_else(|| panic!("no element {id}"));
    rest.split_once("</script>").expect("an end").0
}

/// Rows of text, far from the origin: many different numbers, few, one, none; names to beware of.
fn rows(dimension: usize) -> String {
    let mut text = "id,x,y,z,body,gamma,mass,all,charge\n".to_owned();
    if dimension == 2 {
        text = text.replace(",z,", ",");
    }
    for row in 0..600 {
        let along = f64::from(row);
        let place = [
            1e6 + 0.01 * along,
            -3e5 + (0.1 * along).sin(),
            2e4 - 0.003 * along,
        ];
        let place = place[..dimension]
            .iter()
            .map(f64::to_string)
            .collect::<Vec<_>>()
            .join(",");
        let body = AWKWARD[row as usize % 4].replace('"', "\"\"");
        let gamma = if row % 7 == 0 {
            "nan".to_owned()
        } else {
            (1.0 + 1e-5 * along).to_string()
        };
        text += &format!(
            "{},{place},\"{body}\",{gamma},{},2.5,{}\n",
            20_000_000 + row,
            row % 3,
            1e300 / (1.0 + along)
        );
    }
    text
}

#[test]
fn a_page_holds_every_row() {
    for dimension in [2, 3] {
        let desk = Desk::new().with("rows.csv", rows(dimension));
        let ending = desk.succeed(&["view", "rows.csv"]);
        let last = ending.stdout.lines().last().expect("a line");
        assert!(last.contains("rows.html"), "{last}");
        assert!(
            ending
                .stdout
                .contains(&format!("600 in {dimension}-D, coloured by gamma")),
            "{}",
            ending.stdout
        );
        let page = Page::read(&desk, "rows.html");
        assert_eq!(
            (page.rows(), &page.about["dimension"]),
            (600, &Value::from(dimension))
        );
        let file = Columns::read(&desk.path().join("rows.csv")).expect("columns");
        assert!(file.numbers["gamma"].iter().any(|gamma| gamma.is_nan()));
        assert_eq!(file.words["body"][..4], AWKWARD);
        page.holds(&file);
    }
}

#[test]
fn names_stay_names() {
    let desk = Desk::new()
        .with("rows.csv", rows(2))
        .with("<b>&\"x\".csv", "x,y,<i>\n0,0,1\n1,1,2\n");
    desk.succeed(&["view", "rows.csv"]);
    let page = Page::read(&desk, "rows.html");
    // Every element ends, and none is begun by a name.
    let count = |what: &str| page.text.matches(what).count();
    assert_eq!(count("<script"), count("</script>"));
    assert_eq!(count("alert(1)</script"), 0);
    assert_eq!(count("<b>"), 0);
    // The licence's alone.
    assert_eq!(count("<!--"), 1);
    desk.succeed(&["view", "<b>&\"x\".csv", "-o", "safe.html"]);
    let page = Page::read(&desk, "safe.html");
    assert!(page.text.contains("<title>&lt;b&gt;&amp;\"x\".csv</title>"));
    assert_eq!(page.about["name"], "<b>&\"x\".csv");
}

#[test]
fn a_page_asks_for_nothing() {
    let desk = Desk::new().with("rows.csv", "x,y\n0,0\n1,1\n");
    desk.succeed(&["view", "rows.csv"]);
    let text = Page::read(&desk, "rows.html").text;
    let policy = "default-src 'none'; script-src 'unsafe-inline' blob:; style-src 'unsafe-inline'";
    assert!(text.contains(policy));
    // Scripts are texts of their own; what is left is what the browser reads.
    let mut html = String::new();
    for (number, piece) in text.split("<script").enumerate() {
        let tag_and_rest = piece.split_once("</script>");
        html += match (number, tag_and_rest) {
            (0, _) => piece,
            (_, Some((_, rest))) => rest,
            (_, None) => panic!("a script without an end"),
        };
    }
    for asks in [
        " src=", " href=", "url(", "@import", "http:", "https:", "<link", "<iframe", "<img",
    ] {
        assert!(!html.contains(asks), "{asks}");
    }
    for tag in text.split("<script").skip(1) {
        let tag = tag.split('>').next().expect("a tag");
        assert!(!tag.contains("src"), "{tag}");
    }
}

#[test]
fn every_format_makes_the_same_page() {
    let frozen = "[output]\ninclude = [\"free\", \"boundary\", \"fixed\", \"frozen\"]\n";
    let desk = Desk::new().with("cylinder.toml", CYLINDER.to_owned() + frozen);
    let mut arguments = vec!["pack".to_owned(), "cylinder.toml".to_owned()];
    for (_, ending) in PARTICLE_FORMATS {
        arguments.extend(["-o".to_owned(), format!("c.{ending}")]);
    }
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    desk.succeed(&arguments);
    let file = Columns::read(&desk.path().join("c.csv")).expect("columns");
    assert!(file.numbers["gamma"].iter().any(|gamma| gamma.is_nan()));
    for (_, ending) in PARTICLE_FORMATS {
        let name = format!("c.{ending}");
        desk.succeed(&["view", &name, "--force"]);
        let page = Page::read(&desk, "c.html");
        assert_eq!(
            (&page.about["name"], &page.about["dimension"]),
            (&Value::from(name), &Value::from(2))
        );
        assert_eq!(page.about["diameter_is"], "spacing");
        page.holds(&file);
    }
}

#[test]
fn sizes_are_found_or_guessed() {
    let desk = Desk::new()
        .with("volume.csv", "x,y,volume\n0,0,0.04\n1,1,0.09\n")
        .with("ratio.csv", "x,y,m,rho\n0,0,2,50\n1,1,2,50\n")
        .with("bare.csv", "x,y\n0,0\n0,1\n1,0\n1,1\n")
        .with("one.csv", "x,y\n3,4\n");
    for (name, words, spacing) in [
        ("volume", "root of volume", 0.3),
        ("ratio", "root of mass / density", 0.2),
        ("bare", "guessed: the file has no spacing or volume", 0.5),
        ("one", "guessed: the file has no spacing or volume", 1.0),
    ] {
        desk.succeed(&["view", &format!("{name}.csv")]);
        let about = Page::read(&desk, &format!("{name}.html")).about;
        assert_eq!(about["diameter_is"], words);
        let found = about["spacing"].as_f64().expect("a number");
        assert!((found - spacing).abs() < 1e-12, "{name}: {found}");
    }
}

#[test]
fn what_cannot_be_shown_is_refused_with_the_cure() {
    let desk = Desk::new()
        .with("empty.csv", "")
        .with("header.csv", "x,y\n")
        .with("flat.csv", "x,mass\n0,1\n")
        .with("far.csv", "x,y\n0,inf\n")
        .with("good.csv", "x,y\n0,0\n")
        .with("good.html", "precious");
    desk.refuse(
        &["view", "nothing.vtu"],
        &["nothing.vtu", "there is no such file"],
    );
    desk.refuse(&["view", "empty.csv"], &["empty.csv"]);
    desk.refuse(
        &["view", "header.csv"],
        &["header.csv", "no particles in it"],
    );
    desk.refuse(
        &["view", "flat.csv"],
        &["flat.csv", "no column \"y\"", "as x,y"],
    );
    desk.refuse(
        &["view", "far.csv"],
        &["far.csv", "not a finite number", "correct or remove"],
    );
    desk.refuse(&["view", "part.stl"], &["part.stl"]);
    desk.refuse(
        &["view", "good.csv"],
        &["good.html", "the file exists", "--force"],
    );
    desk.refuse(
        &["view", "good.csv", "-o", "page.png"],
        &["page.png", "name it .html"],
    );
    desk.refuse(
        &["view", "good.csv", "-o", "no/page.html"],
        &["does not exist"],
    );
    assert_eq!(desk.read("good.html"), b"precious");
    desk.succeed(&["view", "good.csv", "--force"]);
    assert_eq!(Page::read(&desk, "good.html").rows(), 1);
}
