//! The particles that the command wrote.

use std::collections::BTreeMap;

/// A particle.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    pub(super) id: String,
    /// z is 0 in the plane.
    pub(super) at: [f64; 3],
    pub(super) kind: String,
    pub(super) side: String,
    pub(super) body: String,
    pub(super) volume: f64,
    pub(super) mass: f64,
    pub(super) gamma: f64,
    pub(super) residual: f64,
    /// Where particles differ in size.
    pub(super) spacing: Option<f64>,
}

impl Row {
    pub(super) fn is_frozen(&self) -> bool {
        self.kind == "frozen"
    }

    /// Whether it sits on a body's surface.
    pub(super) fn is_on_surface(&self) -> bool {
        self.kind == "boundary" || self.kind == "fixed"
    }
}

/// Reads a particle file; names of bodies hold no commas here.
pub(super) fn read(text: &str) -> Result<Vec<Row>, String> {
    let mut lines = text.lines();
    let header = lines.next().ok_or("the particle file is empty")?;
    let places: BTreeMap<&str, usize> = header.split(',').zip(0..).collect();
    let place = |name: &str| {
        places
            .get(name)
            .copied()
            .ok_or(format!("the particle file has no column {name}"))
    };
    let [id, x, y, kind, side, body, volume, mass, gamma, residual] = [
        "id", "x", "y", "kind", "side", "body", "volume", "mass", "gamma", "residual",
    ]
    .map(place);
    let (id, x, y, kind, side, body) = (id?, x?, y?, kind?, side?, body?);
    let (volume, mass, gamma, residual) = (volume?, mass?, gamma?, residual?);
    let z = place("z").ok();
    let spacing = place("spacing").ok();
    let mut rows = Vec::new();
    for line in lines {
        let fields: Vec<&str> = line.split(',').collect();
        if fields.len() != places.len() {
            return Err(format!("a row has {} fields: {line}", fields.len()));
        }
        let word = |k: usize| fields[k].to_owned();
        let number = |k: usize| {
            fields[k]
                .parse::<f64>()
                .map_err(|_| format!("{} is no number", fields[k]))
        };
        rows.push(Row {
            id: word(id),
            at: [number(x)?, number(y)?, z.map_or(Ok(0.0), number)?],
            kind: word(kind),
            side: word(side),
            body: word(body),
            volume: number(volume)?,
            mass: number(mass)?,
            gamma: number(gamma)?,
            residual: number(residual)?,
            spacing: spacing.map(number).transpose()?,
        });
    }
    Ok(rows)
}
