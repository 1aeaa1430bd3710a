//! Files that SPHinXsys reloads, word for word.

use std::path::Path;

use super::solver_tests::some;
use super::tests::written;
use super::*;

#[test]
fn a_file_has_one_body_after_the_other() {
    let text = String::from_utf8(written(ParticleFormat::Reload, &some(2, 5))).unwrap();
    let expected = "\
<?xml version=\"1.0\" encoding=\"UTF-8\"?>
<reload_data>
<body name=\" wing #1, &quot;quoted&quot; 'name' \">
<particle Position=\"0.7666666666666666, -0.4\" VolumetricMeasure=\"0.01\" OriginalID=\"0\"/>
<particle Position=\"1.1, -0.6000000000000001\" VolumetricMeasure=\"0.0097\" OriginalID=\"1\"/>
</body>
<body name=\"flap &amp; &lt;Ω&gt; 翼/\\&gt;\">
<particle Position=\"0.43333333333333335, -0.2\" VolumetricMeasure=\"0.0097\" OriginalID=\"0\"/>
</body>
<body name=\"fluid\">
<particle Position=\"0.1, -0\" VolumetricMeasure=\"0.01\" OriginalID=\"0\"/>
<particle Position=\"1.4333333333333333, -0.8\" VolumetricMeasure=\"0.01\" OriginalID=\"1\"/>
</body>
</reload_data>
";
    assert_eq!(text, expected);
    let text = String::from_utf8(written(ParticleFormat::Reload, &some(3, 1))).unwrap();
    assert!(text.contains("Position=\"0.1, -0, -0.5\""), "{text}");
    // An end without a slash at the end of a name.
    let mut table = some(3, 2);
    table.bodies[1] = "a/".into();
    let bytes = written(ParticleFormat::Reload, &table);
    let columns = Columns::parse(ParticleFormat::Reload, &bytes, Path::new("p")).unwrap();
    assert_eq!(columns.words["body"], ["a/", ""]);
}

#[test]
fn a_file_for_one_body_is_asked_for_by_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let mut table = some(3, 12);
    table.bodies = vec!["wing".into(), "left flap".into(), "void".into()];
    for (file, rows) in [
        ("wing_rld.xml", vec![2, 3, 7, 8]),
        ("left flap_rld.XML", vec![1, 6, 11]),
        ("fluid_rld.xml", vec![0, 4, 5, 9, 10]),
        ("void_rld.xml", vec![]),
    ] {
        let path = folder.path().join(file);
        save(&table, &path, false).unwrap();
        let text = fs::read_to_string(&path).unwrap();
        assert!(
            text.contains("<particles>\n") && !text.contains("body"),
            "{text}"
        );
        let columns = Columns::read(&path).unwrap();
        let x: Vec<f64> = rows.iter().map(|&i: &usize| table.position[i][0]).collect();
        assert_eq!(columns.numbers["x"], x, "{file}");
        let ids: Vec<String> = (0..rows.len())
            .map(|id| format!("OriginalID=\"{id}\""))
            .collect();
        assert!(ids.iter().all(|id| text.contains(id)), "{text}");
    }
    let path = folder.path().join("wnig_rld.xml");
    let message = save(&table, &path, false).unwrap_err().to_string();
    assert!(message.contains("did you mean \"wing\"?"), "{message}");
    assert!(!path.exists());
    // A file for each that has particles; none where one of them cannot be.
    let all = folder.path().join("set-{body}.csv");
    save(&table, &all, false).unwrap();
    for (file, rows) in [
        ("set-wing.csv", 4),
        ("set-left flap.csv", 3),
        ("set-fluid.csv", 5),
    ] {
        let columns = Columns::read(&folder.path().join(file)).unwrap();
        assert_eq!(columns.numbers["x"].len(), rows);
    }
    assert!(!folder.path().join("set-void.csv").exists());
    let message = save(&table, &all, false).unwrap_err().to_string();
    assert!(message.contains("set-wing.csv"), "{message}");
    // All in one are no single body's.
    let path = folder.path().join("Reload.xml");
    save(&table, &path, false).unwrap();
    let columns = Columns::read(&path).unwrap();
    assert_eq!(columns.words["body"].len(), 12);
    table.bodies[2] = "fluid".into();
    let message = save(&table, &path, true).unwrap_err().to_string();
    assert!(message.contains("a body is called \"fluid\""), "{message}");
}

#[test]
fn damaged_files() {
    let good = "<?xml version='1.0'?><!-- by hand --><reload_data>\n<body name='a&amp;b'>\
        <particle Position='1,2 , 3' VolumetricMeasure='.5' OriginalID='0' Extra='1'/></body></reload_data>";
    let read = |text: &str| read_reload(text.as_bytes(), Path::new("p.xml"));
    let columns = read(good).unwrap();
    let all = ["x", "y", "z", "volume"].map(|name| columns.numbers[name][0]);
    assert_eq!(all, [1.0, 2.0, 3.0, 0.5]);
    assert_eq!(columns.words["body"], ["a&b"]);
    let more = "/><particle Position='1,2' VolumetricMeasure='1'/>";
    for (from, to, part) in [
        ("</reload_data>", "", "it is cut off"),
        (
            "<reload_data>",
            "<reload>",
            "no file of particles that SPHinXsys",
        ),
        ("'1,2 , 3'", "'1,2,3,4'", "more than three numbers"),
        ("'1,2 , 3'", "'1'", "different numbers of axes"),
        ("'1,2 , 3'", "'1,b'", "\"b\", which is no finite number"),
        ("'.5'", "'inf'", "\"inf\", which is no finite number"),
        ("VolumetricMeasure", "Volume", "VolumetricMeasure has \"\""),
        ("<body name='a&amp;b'>", "", "a particle is in no body"),
        ("/>", more, "different numbers of axes"),
    ] {
        let message = read(&good.replacen(from, to, 1)).unwrap_err().to_string();
        assert!(message.contains(part), "{message}");
    }
}
