//! Cases of DualSPHysics, by a reader that goes by the description of the format and shares nothing with what writes them.

use std::collections::HashMap;
use std::path::Path;

use super::atomic_tests::names;
use super::solver_tests::some;
use super::*;

/// What the file says, taken from its front.
struct Bytes<'a>(&'a [u8]);

#[derive(Default)]
struct Item {
    name: String,
    text: HashMap<String, String>,
    whole: HashMap<String, u64>,
    real: HashMap<String, Vec<f64>>,
    arrays: HashMap<String, (u32, Vec<f64>)>,
    items: Vec<Self>,
}

impl<'a> Bytes<'a> {
    fn take(&mut self, n: usize) -> &'a [u8] {
        let (front, rest) = self.0.split_at(n);
        self.0 = rest;
        front
    }
    fn u32(&mut self) -> u32 {
        u32::from_le_bytes(self.take(4).try_into().unwrap())
    }
    fn u64(&mut self) -> u64 {
        u64::from_le_bytes(self.take(8).try_into().unwrap())
    }
    fn f32(&mut self) -> f64 {
        f64::from(f32::from_le_bytes(self.take(4).try_into().unwrap()))
    }
    fn f64(&mut self) -> f64 {
        f64::from_le_bytes(self.take(8).try_into().unwrap())
    }
    fn str(&mut self) -> String {
        let n = self.u32() as usize;
        String::from_utf8(self.take(n).to_vec()).unwrap()
    }

    fn item(&mut self, wide: bool) -> Item {
        let size = self.u32() as usize;
        let mut def = Bytes(self.take(size));
        assert_eq!(def.str(), "\nITEM\n");
        let mut item = Item {
            name: def.str(),
            ..Item::default()
        };
        assert_eq!((def.u32(), def.u32()), (0, 0));
        assert_eq!((def.str(), def.str()), ("%.7E".into(), "%.15E".into()));
        let (arrays, items, size) = (def.u32(), def.u32(), def.u32() as usize);
        assert!(def.0.is_empty());
        let mut values = Bytes(self.take(size));
        assert_eq!(values.str(), "\nVALUES");
        for _ in 0..values.u32() {
            let name = values.str();
            match values.u32() {
                1 => drop(item.text.insert(name, values.str())),
                2 | 7 | 8 => drop(item.whole.insert(name, u64::from(values.u32()))),
                10 => drop(item.whole.insert(name, values.u64())),
                12 => drop(item.real.insert(name, vec![values.f64()])),
                23 => drop(
                    item.real
                        .insert(name, (0..3).map(|_| values.f64()).collect()),
                ),
                other => panic!("type {other}"),
            }
        }
        assert!(values.0.is_empty());
        for _ in 0..arrays {
            let size = self.u32() as usize;
            let mut def = Bytes(self.take(size));
            assert_eq!(def.str(), "\nARRAY");
            let name = def.str();
            assert_eq!(def.u32(), 0);
            let kind = def.u32();
            let mut long = || {
                if wide {
                    def.u64()
                } else {
                    u64::from(def.u32())
                }
            };
            let (count, size) = (long() as usize, long() as usize);
            assert!(def.0.is_empty());
            let mut data = Bytes(self.take(size));
            let numbers: Vec<f64> = match kind {
                8 => (0..count).map(|_| f64::from(data.u32())).collect(),
                11 => (0..count).map(|_| data.f32()).collect(),
                22 => (0..3 * count).map(|_| data.f32()).collect(),
                23 => (0..3 * count).map(|_| data.f64()).collect(),
                other => panic!("type {other}"),
            };
            assert!(data.0.is_empty(), "{name}");
            item.arrays.insert(name, (kind, numbers));
        }
        item.items = (0..items).map(|_| self.item(wide)).collect();
        item
    }
}

fn file(bytes: &[u8]) -> Item {
    let mut bytes = Bytes(bytes);
    let title = bytes.take(60);
    assert_eq!(title[..58].trim_ascii_end(), b"#FileJBD JPartDataBi4");
    assert_eq!(&title[58..], b"\n\0");
    let wide = match bytes.take(4) {
        [0, 0, 0, 0] => false,
        [10, 1, 0, 0] => true,
        other => panic!("{other:?}"),
    };
    let root = bytes.item(wide);
    assert!(bytes.0.is_empty());
    root
}

/// Rows by body: the first body, the second, the fluid.
fn expected_order(count: usize) -> Vec<usize> {
    let of = |places: &'static [usize]| (0..count).filter(move |i| places.contains(&(i % 5)));
    of(&[2, 3]).chain(of(&[1])).chain(of(&[0, 4])).collect()
}

#[test]
fn a_file_is_as_described() {
    for (dimension, count, wide) in [
        (2, 23, false),
        (3, 23, false),
        (3, 23, true),
        (2, 0, false),
        (3, 1, false),
    ] {
        let table = some(dimension, count as u32);
        let mut bytes = Vec::new();
        bi4::write(&table, wide, &mut bytes).unwrap();
        let root = file(&bytes);
        let order = expected_order(count);
        let bound = order.iter().filter(|&&i| table.body[i].is_some()).count();
        let axes = |[x, y, z]: [f64; 3]| {
            if dimension == 2 {
                [x, 0.0, y]
            } else {
                [x, y, z]
            }
        };
        assert_eq!(root.name, "JPartDataBi4");
        for (name, value) in [
            ("Piece", 0),
            ("Npiece", 1),
            ("Data2d", u64::from(dimension == 2)),
            ("CaseNp", count as u64),
            ("CaseNfixed", bound as u64),
            ("CaseNmoving", 0),
            ("CaseNfloat", 0),
            ("CaseNfluid", (count - bound) as u64),
            ("PeriMode", 96),
            ("AxisDiv", 99),
        ] {
            assert_eq!(root.whole[name], value, "{name}");
        }
        for name in ["RunCode", "Date", "AppName", "CaseName"] {
            assert!(root.text.contains_key(name));
        }
        for name in ["MapPosMin", "MapPosMax", "PeriXinc", "PeriYinc", "PeriZinc"] {
            assert_eq!(root.real[name], [0.0; 3]);
        }
        assert_eq!(root.real["Data2dPosY"], [0.0]);
        assert_eq!(root.real["Dp"], [0.1]);
        assert_eq!(root.real["H"], [0.12]);
        assert_eq!(root.real["Rhop0"], [1000.0]);
        assert_eq!(root.real["Gamma"], [7.0]);
        let bound_rows = &order[..bound];
        let volume: f64 = bound_rows.iter().map(|&i| table.volume[i]).sum();
        if count > 0 {
            assert_eq!(root.real["MassFluid"], [10.0]);
            let mean = if bound > 0 {
                volume / bound as f64
            } else {
                0.01
            };
            assert!((root.real["MassBound"][0] / (1000.0 * mean) - 1.0).abs() < 1e-12);
        }
        let part = &root.items[0];
        assert_eq!((part.name.as_str(), root.items.len()), ("PART_0000", 1));
        assert_eq!(part.whole["Npok"], count as u64);
        assert_eq!(
            (part.whole["Cpart"], part.whole["Nout"], part.whole["Step"]),
            (0, 0, 0)
        );
        assert_eq!(
            (&part.real["TimeStep"], &part.real["RunTime"]),
            (&vec![0.0], &vec![0.0])
        );
        let array = |name: &str, kind: u32, numbers: Vec<f64>| {
            assert_eq!(part.arrays[name], (kind, numbers), "{name}");
        };
        array("Idp", 8, (0..count).map(|id| id as f64).collect());
        array(
            "Posd",
            23,
            order
                .iter()
                .flat_map(|&i| axes(table.position[i]))
                .collect(),
        );
        array("Vel", 22, vec![0.0; 3 * count]);
        array("Rhop", 11, vec![1000.0; count]);
        assert_eq!(part.arrays.contains_key("BoundNor"), bound > 0);
        if bound > 0 {
            // Half a spacing, none on the exact surface of the second body, none inside.
            let way = bound_rows.iter().flat_map(|&i| {
                let is_near = table.body[i] == Some(0) && table.normals.contains_key(&table.id[i]);
                let size = if is_near { 0.05 } else { 0.0 };
                axes(table.normal(i)).map(|n| f64::from((size * n) as f32))
            });
            array("BoundNor", 22, way.collect());
            let [low, high] = table.bounds().map(axes);
            for (name, corner) in [("Min", low), ("Max", high)] {
                assert_eq!(root.real[&format!("CasePos{name}")], corner);
                assert_eq!(part.real[&format!("Domain{name}")], corner);
            }
        }
    }
}

#[test]
fn the_second_file_says_what_they_are() {
    let mut text = Vec::new();
    write_bi4_xml(&some(2, 23), &mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    for line in [
        "<data2d value=\"true\"/>",
        "<data2dposy value=\"0\" units_comment=\"m\"/>",
        "<gravity x=\"0\" y=\"0\" z=\"-9.81\" units_comment=\"m/s^2\"/>",
        "<rhop0 value=\"1000\" units_comment=\"kg/m^3\"/>",
        "<dp value=\"0.1\" units_comment=\"m\"/>",
        "<massfluid value=\"10\" units_comment=\"kg\"/>",
        "<particles np=\"23\" nb=\"14\" nbf=\"14\" mkboundfirst=\"10\" mkfluidfirst=\"1\">",
        "<fixed mkbound=\"0\" mk=\"10\" begin=\"0\" count=\"9\" comment=\" wing #1, &quot;quoted&quot; 'name' \"/>",
        "<fixed mkbound=\"1\" mk=\"11\" begin=\"9\" count=\"5\" comment=\"flap &amp; &lt;Ω&gt; 翼/\\&gt;\"/>",
        "<fluid mkfluid=\"0\" mk=\"1\" begin=\"14\" count=\"9\"/>",
    ] {
        assert!(text.lines().any(|own| own == line), "{line} in {text}");
    }
    // 20² 9.81 m/s² of 4 m, from the first particle of fluid to the 20th.
    let b = 400.0 * 9.81 * 4.0 * 1000.0 / 7.0;
    let has_b = text
        .lines()
        .filter_map(|line| line.strip_prefix("<b value=\""));
    let is: Vec<f64> = has_b
        .map(|rest| rest.split('"').next().unwrap().parse().unwrap())
        .collect();
    assert!((is[0] / b - 1.0).abs() < 1e-12, "{is:?} {b}");
    let mut text = Vec::new();
    write_bi4_xml(&some(3, 0), &mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    assert!(
        text.contains("<particles np=\"0\" nb=\"0\" nbf=\"0\""),
        "{text}"
    );
    assert!(text.contains("<data2d value=\"false\"/>") && !text.contains("data2dposy"));
}

#[test]
fn both_files_or_none() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("case.bi4");
    let names = || names(&folder);
    let table = some(3, 12);
    let mut two_masses = table.clone();
    two_masses.mass[4] *= 1.001;
    let message = save(&two_masses, &path, false).unwrap_err().to_string();
    for part in [
        "one mass for all of the fluid",
        "particle 56 has",
        "packing.masses = \"equal\"",
    ] {
        assert!(message.contains(part), "{message}");
    }
    let mut periodic = table.clone();
    periodic.shared.periodic[1] = true;
    assert!(save(&periodic, &path, false).is_err());
    assert!(names().is_empty());
    fs::write(folder.path().join("case.xml"), "precious").unwrap();
    let message = save(&table, &path, false).unwrap_err().to_string();
    assert!(message.contains("case.xml: the file exists"), "{message}");
    assert_eq!(names(), ["case.xml"]);
    save(&table, &path, true).unwrap();
    assert_eq!(names(), ["case.bi4", "case.xml"]);
    assert!(
        fs::read_to_string(folder.path().join("case.xml"))
            .unwrap()
            .contains("np=\"12\"")
    );
    let columns = Columns::read(&path).unwrap();
    assert_eq!(columns.numbers["x"].len(), 12);
}

#[test]
fn what_differs_is_found() {
    let good = some(2, 12);
    let mut bytes = Vec::new();
    write_bi4(&good, &mut bytes).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p");
    fs::write(&path, &bytes).unwrap();
    assert_eq!(compare(&good, ParticleFormat::Bi4, &path), Ok(true));
    type Change = fn(&mut Table);
    let changes: [(&str, Change); 6] = [
        ("x", |t| t.position[2][0] = 9.0),
        ("y", |t| t.position[0][1] = 9.0),
        ("m", |t| t.volume[2] *= 2.0),
        ("rho", |t| t.shared.density[3] *= 2.0),
        ("to_surface_x", |t| t.shared.inset[0] *= 2.0),
        ("side", |t| t.side[4] = sphpack_separation::Side::Solid),
    ];
    for (name, change) in changes {
        let mut other = good.clone();
        change(&mut other);
        let message = compare(&other, ParticleFormat::Bi4, &path).unwrap_err();
        assert!(
            message.contains(&format!(" {name} of particle ")) || name == "rho",
            "{name}: {message}"
        );
    }
}

#[test]
fn damaged_files() {
    let mut good = Vec::new();
    write_bi4(&some(3, 12), &mut good).unwrap();
    let read = |bytes: &[u8]| read_bi4(bytes, Path::new("p.bi4"));
    assert!(read(&good).is_ok());
    for end in 0..good.len() {
        assert!(read(&good[..end]).is_err(), "{end}");
    }
    let at = |what: &[u8]| {
        good.windows(what.len())
            .position(|window| window == what)
            .unwrap()
    };
    for (place, byte, part) in [
        (3, b'x', "no file of particles of DualSPHysics"),
        (60, 1, "big-endian"),
        (67, 255, "cut off"),
        (at(b"\nITEM"), b' ', "does not begin with"),
        (at(b"\nVALUES"), b' ', "values do not begin"),
        (at(b"CaseNfluid"), b'K', "no CaseNfluid"),
        (at(b"Posd"), b'K', "no array Pos"),
        (at(b"Rhop\0") + 8, 23, "no whole rows"),
    ] {
        let mut bad = good.clone();
        bad[place] = byte;
        let message = read(&bad).map(|_| ()).unwrap_err().to_string();
        assert!(message.contains(part), "{place}: {message}");
    }
}

#[test]
fn columns_alone_say_enough() {
    let mut table = some(3, 12);
    table.density = (0..12).map(|i| table.density_of(i)).collect();
    table.spacing = vec![0.1; 12];
    table.smoothing_length = vec![0.12; 12];
    let common = std::mem::take(&mut table.shared);
    let mut text = Vec::new();
    write_bi4_xml(&table, &mut text).unwrap();
    table.shared = common;
    let mut instead = Vec::new();
    write_bi4_xml(&table, &mut instead).unwrap();
    assert_eq!(text, instead);
    // Without fluid nobody knows its density.
    let mut walls = table.filtered(|i| table.body[i].is_some());
    walls.shared = Default::default();
    let message = write_bi4(&walls, &mut Vec::new()).unwrap_err().to_string();
    assert!(
        message.contains("nothing says the density of the fluid"),
        "{message}"
    );
}
