//! Which keys somebody has written.

/// The keys that a scene's file has in `[packing]`. They make no difference to what a scene is, so two scenes are compared
/// without them: a scene that is written with its defaults filled in is the same scene. With the method "auto" they tell
/// what is somebody's own choice.
#[derive(Debug, Clone, Default)]
pub struct Given(Vec<String>);

impl Given {
    pub(super) fn new(keys: Vec<String>) -> Self {
        Self(keys)
    }

    /// Whether a key was written.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.0.iter().any(|given| given == key)
    }
}

impl PartialEq for Given {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}
