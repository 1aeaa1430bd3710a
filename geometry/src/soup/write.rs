//! Meshes into binary STL files.

use std::io::{self, Write};

use sphpack_neighbors::point;

use super::Soup;
use crate::mesh::triangle;

/// What a binary file begins with; it must not begin with "solid", the mark of text files.
const TITLE: &[u8] = b"binary STL, written by sphpack";

impl Soup {
    /// Writes a binary STL file: 50 bytes per triangle, coordinates with 32 bits.
    ///
    /// # Errors
    /// What `to` says, and [`io::ErrorKind::InvalidInput`] for more than 2³² − 1 triangles.
    pub fn write_stl(&self, to: &mut dyn Write) -> io::Result<()> {
        let count = u32::try_from(self.triangles.len())
            .map_err(|_| io::Error::new(io::ErrorKind::InvalidInput, "too many triangles"))?;
        let mut head = [b' '; 80];
        head[..TITLE.len()].copy_from_slice(TITLE);
        to.write_all(&head)?;
        to.write_all(&count.to_le_bytes())?;
        for t in 0..self.triangles.len() {
            let corners = self.corners(t);
            let normal = point::unit(triangle::area_vector(&corners)).unwrap_or([0.0; 3]);
            let mut record = [0; 50];
            let numbers = normal.iter().chain(corners.as_flattened());
            for (place, &x) in record.chunks_exact_mut(4).zip(numbers) {
                place.copy_from_slice(&(x as f32).to_le_bytes());
            }
            to.write_all(&record)?;
        }
        Ok(())
    }
}
