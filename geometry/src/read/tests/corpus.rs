//! Every file of the corpus is a body, or is refused.

use super::*;

#[test]
fn every_file_of_the_corpus_is_a_body() {
    for format in BodyFormat::ALL {
        let files = files(format);
        assert!(files.len() > 1, "{format:?}");
        for (name, bytes) in files {
            let result = contents(format, &bytes);
            if name.starts_with("bad_") {
                assert!(result.is_err(), "{name}");
                continue;
            }
            assert!(
                result.as_ref().is_ok_and(|&c| c > 0.0),
                "{name}: {result:?}"
            );
            // Without a name, an airfoil that goes round in one run is rows like others.
            let (_, extension) = name.rsplit_once('.').unwrap();
            assert_eq!(BodyFormat::detect(&bytes, extension), Ok(format), "{name}");
            let unnamed = BodyFormat::detect(&bytes, "").unwrap();
            assert_eq!(unnamed.dimension(), format.dimension(), "{name}");
            if format != BodyFormat::Airfoil {
                assert_eq!(unnamed, format, "{name}");
            }
        }
    }
}
