//! Pieces of DualSPHysics's binary files: a head, items with values, arrays (`JBinaryData.cpp`).

/// Numbers of types.
pub(super) const TEXT: i32 = 1;
pub(super) const BOOL: i32 = 2;
pub(super) const INT: i32 = 7;
pub(super) const UINT: i32 = 8;
pub(super) const ULONG: i32 = 10;
pub(super) const FLOAT: i32 = 11;
pub(super) const DOUBLE: i32 = 12;
pub(super) const FLOAT3: i32 = 22;
pub(super) const DOUBLE3: i32 = 23;

/// What an item says by name.
pub(super) enum Value<'a> {
    Text(&'a str),
    Bool(bool),
    Int(i32),
    Uint(u32),
    Ulong(u64),
    Double(f64),
    Double3([f64; 3]),
}

/// What each part begins with.
pub(super) const ITEM: &str = "\nITEM\n";
pub(super) const VALUES: &str = "\nVALUES";
pub(super) const ARRAY: &str = "\nARRAY";

/// Bytes of the head.
pub(super) const HEAD: usize = 64;

/// What a file of particles begins with.
pub(super) const TITLE: &[u8] = b"#FileJBD JPartDataBi4";

/// The first bytes of a little-endian file; with `is_wide`, sizes of arrays have 64 bits.
pub(super) fn head(is_wide: bool) -> Vec<u8> {
    let mut bytes = TITLE.to_vec();
    bytes.resize(58, b' ');
    bytes.extend([b'\n', 0]);
    bytes.extend([10 * u8::from(is_wide), u8::from(is_wide), 0, 0]);
    bytes
}

fn text(words: &str, to: &mut Vec<u8>) {
    to.extend((words.len() as u32).to_le_bytes());
    to.extend(words.bytes());
}

/// An item up to its arrays and items, which follow.
pub(super) fn item(name: &str, values: &[(&str, Value<'_>)], arrays: u32, items: u32) -> Vec<u8> {
    let mut said = Vec::new();
    text(VALUES, &mut said);
    said.extend((values.len() as u32).to_le_bytes());
    for (name, value) in values {
        text(name, &mut said);
        let mut put = |kind: i32, bytes: &[u8]| {
            said.extend(kind.to_le_bytes());
            said.extend(bytes);
        };
        match value {
            Value::Text(words) => {
                put(TEXT, &(words.len() as u32).to_le_bytes());
                said.extend(words.bytes());
            }
            Value::Bool(is) => put(BOOL, &i32::from(*is).to_le_bytes()),
            Value::Int(number) => put(INT, &number.to_le_bytes()),
            Value::Uint(number) => put(UINT, &number.to_le_bytes()),
            Value::Ulong(number) => put(ULONG, &number.to_le_bytes()),
            Value::Double(number) => put(DOUBLE, &number.to_le_bytes()),
            Value::Double3(numbers) => {
                let bytes: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes()).collect();
                put(DOUBLE3, &bytes);
            }
        }
    }
    let mut definition = Vec::new();
    text(ITEM, &mut definition);
    text(name, &mut definition);
    // Neither the item nor its values are hidden.
    definition.extend([0; 8]);
    text("%.7E", &mut definition);
    text("%.15E", &mut definition);
    for number in [arrays, items, said.len() as u32] {
        definition.extend(number.to_le_bytes());
    }
    let mut bytes = (definition.len() as u32).to_le_bytes().to_vec();
    bytes.extend(definition);
    bytes.extend(said);
    bytes
}

/// An array up to its numbers, `count` times `size` bytes, which follow.
pub(super) fn array(name: &str, kind: i32, count: usize, size: usize, is_wide: bool) -> Vec<u8> {
    let mut definition = Vec::new();
    text(ARRAY, &mut definition);
    text(name, &mut definition);
    definition.extend([0; 4]);
    definition.extend(kind.to_le_bytes());
    for number in [count as u64, (count * size) as u64] {
        let width = if is_wide { 8 } else { 4 };
        definition.extend(&number.to_le_bytes()[..width]);
    }
    let mut bytes = (definition.len() as u32).to_le_bytes().to_vec();
    bytes.extend(definition);
    bytes
}
