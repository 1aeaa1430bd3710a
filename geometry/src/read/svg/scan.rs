//! Numbers and words of SVG attributes, one after another.

/// Goes through an attribute's value.
#[derive(Debug, Clone)]
pub(super) struct Scan<'a> {
    text: &'a [u8],
    at: usize,
}

impl<'a> Scan<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self {
            text: text.as_bytes(),
            at: 0,
        }
    }

    /// How far it has come, bytes.
    pub(super) fn place(&self) -> usize {
        self.at
    }

    pub(super) fn peek(&self) -> Option<u8> {
        self.text.get(self.at).copied()
    }

    pub(super) fn skip_space(&mut self) {
        while self.peek().is_some_and(|b| b.is_ascii_whitespace()) {
            self.at += 1;
        }
    }

    /// Passes over space and at most one comma.
    pub(super) fn skip_separator(&mut self) {
        self.skip_space();
        if self.peek() == Some(b',') {
            self.at += 1;
            self.skip_space();
        }
    }

    /// Whether the next byte is this one; passes over it.
    pub(super) fn take(&mut self, byte: u8) -> bool {
        let is_there = self.peek() == Some(byte);
        self.at += usize::from(is_there);
        is_there
    }

    /// The letters that come next.
    pub(super) fn letters(&mut self) -> &'a [u8] {
        let start = self.at;
        while self.peek().is_some_and(|b| b.is_ascii_alphabetic()) {
            self.at += 1;
        }
        &self.text[start..self.at]
    }

    fn digits(&mut self) -> usize {
        let start = self.at;
        while self.peek().is_some_and(|b| b.is_ascii_digit()) {
            self.at += 1;
        }
        self.at - start
    }

    /// A finite number, which ends where it can: "1.5.5" is two, "1-2" too.
    pub(super) fn number(&mut self) -> Option<f64> {
        let start = self.at;
        if matches!(self.peek(), Some(b'+' | b'-')) {
            self.at += 1;
        }
        let mut digits = self.digits();
        if self.take(b'.') {
            digits += self.digits();
        }
        if digits > 0 && matches!(self.peek(), Some(b'e' | b'E')) {
            let mantissa = self.at;
            self.at += 1;
            if matches!(self.peek(), Some(b'+' | b'-')) {
                self.at += 1;
            }
            // "2em" is 2 and a unit.
            if self.digits() == 0 {
                self.at = mantissa;
            }
        }
        let value = std::str::from_utf8(&self.text[start..self.at])
            .ok()
            .and_then(|text| text.parse::<f64>().ok())
            .filter(|value| digits > 0 && value.is_finite());
        if value.is_none() {
            self.at = start;
        }
        value
    }

    /// A flag of an arc: 0 or 1, with nothing needed after it.
    pub(super) fn flag(&mut self) -> Option<bool> {
        let flag = match self.peek()? {
            b'0' => false,
            b'1' => true,
            _ => return None,
        };
        self.at += 1;
        Some(flag)
    }
}

/// A length in user units: a number alone, or with one of the units of CSS, 96 to an inch.
pub(super) fn length(text: &str) -> Result<f64, String> {
    let mut scan = Scan::new(text.trim());
    let bad = || {
        format!("\"{text}\" is not a length such as 12.5 or 12.5mm; set it in the drawing's units")
    };
    let number = scan.number().ok_or_else(bad)?;
    let factor = match scan.letters() {
        b"" | b"px" => 1.0,
        b"mm" => 96.0 / 25.4,
        b"cm" => 96.0 / 2.54,
        b"in" => 96.0,
        b"pt" => 96.0 / 72.0,
        b"pc" => 16.0,
        _ => return Err(bad()),
    };
    if scan.peek().is_some() {
        return Err(bad());
    }
    Ok(number * factor)
}
