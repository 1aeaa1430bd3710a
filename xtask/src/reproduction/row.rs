//! One number of a paper, and what stands beside it.

use super::measure::Measure;
use super::setup::Setup;
use super::subject::Subject;

/// What a paper says.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Published {
    /// A number in its text or tables.
    Text(f64),
    /// A claim in words, and no number.
    Words(&'static str),
}

/// When a row holds.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Bar {
    /// No more than this.
    AtMost(f64),
    /// No less than this.
    AtLeast(f64),
    /// Printed beside, not judged: a paper's figure of a method that it advises against, or a figure of ours.
    Beside,
}

/// How a row's number comes of figures.
#[derive(Debug, Clone)]
pub(crate) enum Taken {
    /// It is the subject's.
    Alone,
    /// This one's over the subject's.
    Over(Subject),
    /// The power of ∆s that the figure grows with, from the subject and these packings.
    Slope(Vec<Setup>),
    /// The standard error of that power.
    SlopeError(Vec<Setup>),
    /// The greatest of the subject's and those of these packings, which differ in h/∆s.
    Greatest(Vec<Setup>),
}

impl Taken {
    /// What is measured besides the subject.
    pub(crate) fn others(&self) -> Vec<Subject> {
        match self {
            Self::Alone => Vec::new(),
            Self::Over(over) => vec![*over],
            Self::Slope(others) | Self::SlopeError(others) | Self::Greatest(others) => {
                others.iter().map(|&setup| setup.into()).collect()
            }
        }
    }

    /// What follows the subject's words.
    pub(crate) fn words(&self) -> String {
        let spacings = |others: &[Setup]| {
            let all: Vec<String> = (others.iter())
                .map(|setup| (setup.spacing / setup.enlarged).to_string())
                .collect();
            all.join(", ")
        };
        match self {
            Self::Alone => String::new(),
            Self::Over(over) => format!("; {} over it", over.short()),
            Self::Slope(others) => format!("; slope over ∆s, with {}", spacings(others)),
            Self::SlopeError(others) => {
                format!(
                    "; standard error of the slope over ∆s, with {}",
                    spacings(others)
                )
            }
            Self::Greatest(others) => {
                let last = others.last().and_then(|setup| setup.h_over_spacing);
                format!("; greatest up to h/∆s = {}", last.unwrap_or(f64::NAN))
            }
        }
    }
}

/// A number of a paper beside ours.
#[derive(Debug, Clone)]
pub(crate) struct Row {
    /// The paper's number in docs/papers.md.
    pub(crate) paper: &'static str,
    /// "fig12", "table1".
    pub(crate) figure: &'static str,
    pub(crate) subject: Subject,
    pub(crate) taken: Taken,
    pub(crate) measure: Measure,
    pub(crate) published: Published,
    pub(crate) bar: Bar,
    /// Whether it runs with `--quick`.
    pub(crate) quick: bool,
    /// Whether it takes so long that it runs with `--fine` alone.
    pub(crate) fine: bool,
}

impl Row {
    /// What tells it from all others.
    pub(crate) fn id(&self) -> String {
        // A ratio has had this name from the first.
        let taken = match &self.taken {
            Taken::Over(over) => format!(" under {}", over.short()),
            other => other.words(),
        };
        format!(
            "{} {}: {}{}{taken}: {}",
            self.paper,
            self.figure,
            self.subject.words(),
            self.subject.remark(),
            self.measure.name()
        )
    }

    /// Whether a figure holds; `None` where the row is not judged.
    pub(crate) fn holds(&self, ours: f64) -> Option<bool> {
        match self.bar {
            Bar::AtMost(most) => Some(ours <= most),
            Bar::AtLeast(least) => Some(ours >= least),
            Bar::Beside => None,
        }
    }
}

/// A figure of a paper: what it shows, in our words.
pub(crate) struct Figure {
    pub(crate) paper: &'static str,
    pub(crate) figure: &'static str,
    pub(crate) claim: &'static str,
    /// Why it has no rows yet.
    pub(crate) missing: Option<&'static str>,
}
