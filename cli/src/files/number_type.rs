//! Types of numbers in binary files, and their bytes.

/// Which byte of a number comes first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ByteOrder {
    /// The least.
    Little,
    /// The greatest.
    Big,
}

/// A type of numbers; all become 64-bit floating point when read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NumberType {
    F64,
    F32,
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
}

impl NumberType {
    /// Bytes of one number.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::F32 | Self::I32 | Self::U32 => 4,
            Self::F64 | Self::I64 | Self::U64 => 8,
        }
    }

    /// The number in the first bytes of `bytes`; `None` where there are too few.
    pub(super) fn number(self, order: ByteOrder, bytes: &[u8]) -> Option<f64> {
        macro_rules! number {
            ($type:ty) => {{
                let mut raw = [0; size_of::<$type>()];
                raw.copy_from_slice(bytes.get(..size_of::<$type>())?);
                (match order {
                    ByteOrder::Little => <$type>::from_le_bytes(raw),
                    ByteOrder::Big => <$type>::from_be_bytes(raw),
                }) as f64
            }};
        }
        Some(match self {
            Self::F64 => number!(f64),
            Self::F32 => number!(f32),
            Self::I8 => number!(i8),
            Self::U8 => number!(u8),
            Self::I16 => number!(i16),
            Self::U16 => number!(u16),
            Self::I32 => number!(i32),
            Self::U32 => number!(u32),
            Self::I64 => number!(i64),
            Self::U64 => number!(u64),
        })
    }

    /// All whole numbers in `bytes`.
    pub(super) fn numbers(self, order: ByteOrder, bytes: &[u8]) -> Vec<f64> {
        bytes
            .chunks_exact(self.size())
            .filter_map(|chunk| self.number(order, chunk))
            .collect()
    }
}
