//! What an unfinished packing needs to go on: values as bytes, and back. What is read is not trusted.

use std::io::{self, Write};

use crate::particles::{Kind, Particles};

/// A state that was not written by this version for this problem, or that was changed since.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("it is damaged, or belongs to another problem")]
pub struct Damaged;

/// Something that can be saved, and brought back over one that began anew.
pub(crate) trait State {
    /// Appends what cannot be found out again.
    fn save(&self, out: &mut dyn Write) -> io::Result<()>;

    /// Takes what [`State::save`] appended off the front of `from`. Where that fails, this is left in between.
    fn load(&mut self, from: &mut &[u8]) -> Result<(), Damaged>;
}

/// A plain value.
pub(crate) trait Value: Sized {
    /// Bytes that every value takes, at least.
    const LEAST: usize;

    /// Appends it: numbers as their bits, the lowest byte first.
    fn put(&self, out: &mut dyn Write) -> io::Result<()>;

    /// Takes it off the front.
    fn take(from: &mut &[u8]) -> Result<Self, Damaged>;
}

impl<T: Value> State for T {
    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.put(out)
    }

    fn load(&mut self, from: &mut &[u8]) -> Result<(), Damaged> {
        *self = Self::take(from)?;
        Ok(())
    }
}

macro_rules! numbers {
    ($($number:ty)*) => {$(
        impl Value for $number {
            const LEAST: usize = size_of::<Self>();

            fn put(&self, out: &mut dyn Write) -> io::Result<()> {
                out.write_all(&self.to_le_bytes())
            }

            fn take(from: &mut &[u8]) -> Result<Self, Damaged> {
                let (bytes, rest) = from.split_first_chunk().ok_or(Damaged)?;
                *from = rest;
                Ok(Self::from_le_bytes(*bytes))
            }
        }
    )*};
}

numbers!(u8 u16 u32 u64 f32 f64);

/// No count of anything is larger: sums of a few do not overflow.
const LARGEST_COUNT: u64 = 1 << 48;

impl Value for usize {
    const LEAST: Self = 8;

    fn put(&self, out: &mut dyn Write) -> io::Result<()> {
        (*self as u64).put(out)
    }

    fn take(from: &mut &[u8]) -> Result<Self, Damaged> {
        let count = u64::take(from)?;
        let count = (count <= LARGEST_COUNT).then_some(count).ok_or(Damaged)?;
        Self::try_from(count).map_err(|_| Damaged)
    }
}

impl Value for bool {
    const LEAST: usize = 1;

    fn put(&self, out: &mut dyn Write) -> io::Result<()> {
        u8::from(*self).put(out)
    }

    fn take(from: &mut &[u8]) -> Result<Self, Damaged> {
        match u8::take(from)? {
            0 => Ok(false),
            1 => Ok(true),
            _ => Err(Damaged),
        }
    }
}

impl Value for Kind {
    const LEAST: usize = 1;

    fn put(&self, out: &mut dyn Write) -> io::Result<()> {
        let place = Self::ALL.iter().position(|kind| kind == self);
        (place.unwrap_or_default() as u8).put(out)
    }

    fn take(from: &mut &[u8]) -> Result<Self, Damaged> {
        let place = usize::from(u8::take(from)?);
        Self::ALL.get(place).copied().ok_or(Damaged)
    }
}

impl<T: Value> Value for Option<T> {
    const LEAST: usize = 1;

    fn put(&self, out: &mut dyn Write) -> io::Result<()> {
        self.is_some().put(out)?;
        if let Some(value) = self {
            value.put(out)?;
        }
        Ok(())
    }

    fn take(from: &mut &[u8]) -> Result<Self, Damaged> {
        bool::take(from)?.then(|| T::take(from)).transpose()
    }
}

impl<T: Value + Copy, const N: usize> Value for [T; N] {
    const LEAST: usize = N * T::LEAST;

    fn put(&self, out: &mut dyn Write) -> io::Result<()> {
        for value in self {
            value.put(out)?;
        }
        Ok(())
    }

    fn take(from: &mut &[u8]) -> Result<Self, Damaged> {
        let mut values = [T::take(from)?; N];
        for value in values.iter_mut().skip(1) {
            *value = T::take(from)?;
        }
        Ok(values)
    }
}

impl<T: Value> Value for Vec<T> {
    const LEAST: usize = 8;

    fn put(&self, out: &mut dyn Write) -> io::Result<()> {
        put_list(self, out)
    }

    fn take(from: &mut &[u8]) -> Result<Self, Damaged> {
        let count = usize::take(from)?;
        // A length that is claimed is no reason to allocate.
        if count > from.len() / T::LEAST.max(1) {
            return Err(Damaged);
        }
        (0..count).map(|_| T::take(from)).collect()
    }
}

macro_rules! tuples {
    ($($($name:ident)*;)*) => {$(
        impl<$($name: Value),*> Value for ($($name,)*) {
            const LEAST: usize = 0 $(+ $name::LEAST)*;

            #[allow(non_snake_case, reason = "the parts go by the names of their types")]
            fn put(&self, out: &mut dyn Write) -> io::Result<()> {
                let ($($name,)*) = self;
                $($name.put(out)?;)*
                Ok(())
            }

            fn take(from: &mut &[u8]) -> Result<Self, Damaged> {
                Ok(($($name::take(from)?,)*))
            }
        }
    )*};
}

tuples! {
    A B;
    A B C;
    A B C D;
}

/// A struct that is the values of its fields.
macro_rules! values {
    ($name:ident $([$($generic:tt)*])? { $($field:ident: $type:ty),* $(,)? }) => {
        impl $(<$($generic)*>)? $crate::state::Value for $crate::state::values!(@ $name $([$($generic)*])?) {
            const LEAST: usize = 0 $(+ <$type as $crate::state::Value>::LEAST)*;

            fn put(&self, out: &mut dyn std::io::Write) -> std::io::Result<()> {
                $($crate::state::Value::put(&self.$field, out)?;)*
                Ok(())
            }

            fn take(from: &mut &[u8]) -> Result<Self, $crate::state::Damaged> {
                Ok(Self { $($field: $crate::state::Value::take(from)?),* })
            }
        }
    };
    (@ $name:ident) => { $name };
    (@ $name:ident [const D: usize]) => { $name<D> };
}

pub(crate) use values;

/// Appends a list, to be taken as a `Vec`.
pub(crate) fn put_list<T: Value>(list: &[T], out: &mut dyn Write) -> io::Result<()> {
    list.len().put(out)?;
    for value in list {
        value.put(out)?;
    }
    Ok(())
}

/// Loads a list that has as many entries as it has already.
pub(crate) fn load_as_many<T: Value>(list: &mut Vec<T>, from: &mut &[u8]) -> Result<(), Damaged> {
    let loaded = Vec::take(from)?;
    if loaded.len() != list.len() {
        return Err(Damaged);
    }
    *list = loaded;
    Ok(())
}

/// Whether all places can be looked for in a grid.
pub(crate) fn all_finite<const D: usize>(places: &[[f64; D]]) -> bool {
    (places.iter().flatten()).all(|x| x.is_finite())
}

/// What changes: ids, volumes and bodies stay as they were seeded, but where a method captures particles.
impl<const D: usize> State for Particles<D> {
    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.position.save(out)?;
        self.kind.save(out)
    }

    fn load(&mut self, from: &mut &[u8]) -> Result<(), Damaged> {
        load_as_many(&mut self.position, from)?;
        load_as_many(&mut self.kind, from)?;
        all_finite(&self.position).then_some(()).ok_or(Damaged)
    }
}
