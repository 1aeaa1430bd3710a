//! Outlines from rows and airfoil files.

use super::*;

#[test]
fn rows_are_read_as_they_were_written() {
    let loops = vec![
        vec![[0.1, -2e-7], [4.0, 0.0], [1.0 / 3.0, 4e3]],
        vec![[1.0, 1.0], [2.0, 1.0], [1.0, 2.0], [1.0, 1.0]],
    ];
    for separator in [",", ";", " ", "\t", " , "] {
        for end in ["\n", "\r\n", "\r"] {
            for head in [
                "",
                "x,y\n",
                "\u{feff}X;Y\r\n",
                "# a comment\n\n",
                "Göttingen\n",
            ] {
                let mut text = head.to_owned();
                for one in &loops {
                    for [x, y] in one {
                        text += &format!(" {x}{separator}{y:e}  {end}");
                    }
                    text += &format!("  {end}{end}");
                }
                assert_eq!(
                    BodyFormat::Csv.loops(text.as_bytes()).as_ref(),
                    Ok(&loops),
                    "{text:?}"
                );
            }
        }
    }
    // A title in another encoding than UTF-8 is passed over too.
    let text = b"G\xf6ttingen\n0,0\n1,0\n0,1\n";
    assert_eq!(contents(BodyFormat::Csv, text), Ok(0.5));
    let fortran = file(BodyFormat::Csv, "fortran.csv");
    assert_eq!(contents(BodyFormat::Csv, &fortran), Ok(0.5));
}

#[test]
fn airfoils_of_every_kind_are_the_same_body() {
    let area = |name: &str| contents(BodyFormat::Airfoil, &file(BodyFormat::Airfoil, name));
    let expected = area("selig.dat").unwrap();
    assert!((expected - 0.081).abs() < 2e-3, "{expected}");
    for name in [
        "selig_clockwise.dat",
        "lednicer.dat",
        "lednicer_backwards.dat",
        "halves.dat",
        "counted.dat",
        "text_after.dat",
        "table_after.dat",
        "two_titles.dat",
        "mses_domain.dat",
        "number_title.dat",
        "two_numbers_title.dat",
        "three_columns.dat",
        "headings.dat",
    ] {
        let area = area(name).unwrap();
        assert!((area - expected).abs() < 1e-14, "{name}: {area}");
    }
    let two = area("elements.dat").unwrap();
    assert!((two - 1.09 * expected).abs() < 1e-6, "{two}");
}

#[test]
fn airfoils_close_where_they_are_open_and_drop_repeats() {
    // A blunt trailing edge stays blunt.
    let blunt = "blunt\n1 0.01\n0.5 0.1\n0 0\n0 0\n0.5 -0.1\n1 -0.01\n";
    let outline = Outline::from_bytes(BodyFormat::Airfoil, blunt.as_bytes()).unwrap();
    assert_eq!(outline.points().len(), 5);
    assert_eq!(outline.features().corners.len(), 3);
    let closed = "sharp\n1 0\n0.5 0.1\n0 0\n0.5 -0.1\n1 0\n1 0\n";
    let outline = Outline::from_bytes(BodyFormat::Airfoil, closed.as_bytes()).unwrap();
    assert_eq!(outline.points().len(), 4);
    // Points that could be numbers of points are none without a name.
    let numbers = "2 3\n0 0\n9 0\n9 9\n0 9\n1 8\n";
    let outline = Outline::from_bytes(BodyFormat::Airfoil, numbers.as_bytes()).unwrap();
    assert_eq!(outline.points().len(), 6);
    // Two elements that a blank line parts.
    let two = "0 0\n1 0\n0 1\n0 0\n\n5 0\n5 1\n6 0\n5 0\n";
    let outline = Outline::from_bytes(BodyFormat::Airfoil, two.as_bytes()).unwrap();
    assert_eq!(outline.loops().len(), 2);
}

#[test]
fn bad_airfoils_say_where() {
    let dat = |content: &str, parts: &[&str]| refused(BodyFormat::Airfoil, content, parts);
    dat(
        "a\n 3. 3.\n\n0 0\n1 0\n",
        &["line 2", "3 and 3 points", "2 follow"],
    );
    dat("a\n7\n0 0\n1 0\n0 1\n", &["line 2", "7 points", "3 follow"]);
    dat("a\nb\n0 0\n", &["1 different points"]);
    dat("a\n0.0 .....\n1 0\n0 1\n", &["line 2", "two"]);
    dat("a\n0 0\n0.5 (0.1)\n1 0\n", &["line 3", "two"]);
    dat("a\n0 0\n1.0 x\n", &["line 3", "finite"]);
    dat("", &["0 different points"]);
    dat("a\0b", &["text"]);
}

#[test]
fn decimal_commas_where_they_are_plain() {
    let area = |name: &str| contents(BodyFormat::Csv, &file(BodyFormat::Csv, name));
    assert_eq!(area("decimal_commas.csv"), Ok(1.875));
    assert_eq!(area("quoted.csv"), Ok(0.5));
    let tabs = b"0,0\t0\n1,5\t0\n1,5\t1,25\n";
    assert_eq!(contents(BodyFormat::Csv, tabs), Ok(0.9375));
    for row in [
        "1,5,2,5",
        "1,5 2,5",
        "1,5;2.5",
        "1,5;2,5,1",
        ",5;1,0",
        "1,0;5,",
    ] {
        refused(BodyFormat::Csv, format!("0;0\n{row}\n1;1\n"), &["line 2"]);
    }
}
