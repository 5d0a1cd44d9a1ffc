//! Values per corner that are the same at all corners of a vertex.

use std::borrow::Cow;

use super::layer::{Layer, NO_ROW, On, Values};
use super::{Document, Numbers};

impl Document {
    /// The document with those layers per corner moved to the vertices whose corners agree at every
    /// vertex, where the vertices have no layer of that role: OBJ files often say per corner what holds
    /// per vertex.
    pub fn folded(&self) -> Cow<'_, Self> {
        let fold = |l: &Layer| {
            let free = l.on == On::Corner && self.layer(On::Vertex, l.role).is_none();
            let values = free.then(|| self.agreed(&l.values)).flatten()?;
            values.is_complete().then(|| gathered(values))
        };
        let folds: Vec<Option<Values>> = self.layers.iter().map(fold).collect();
        if folds.iter().all(Option::is_none) {
            return Cow::Borrowed(self);
        }
        let mut folded = self.clone();
        for (layer, values) in folded.layers.iter_mut().zip(folds) {
            if let Some(values) = values {
                (layer.on, layer.values) = (On::Vertex, values);
            }
        }
        Cow::Owned(folded)
    }

    /// Values of corners as values of vertices, where all corners of each vertex have the same.
    pub(in crate::shape) fn agreed(&self, values: &Values) -> Option<Values> {
        let (width, numbers) = (values.width()?, values.numbers()?);
        let mut of = vec![NO_ROW; self.mesh.positions.len()];
        for (i, &v) in self.mesh.polygons.iter().flatten().enumerate() {
            let row = values.row(i)?;
            let known = of.get_mut(v as usize)?;
            if *known == NO_ROW {
                *known = row as u32;
            }
            let number = |row: usize, k: usize| numbers.get(row * width + k).to_bits();
            if !(0..width).all(|k| number(row, k) == number(*known as usize, k)) {
                return None;
            }
        }
        Some(Values::Pool {
            width,
            numbers: numbers.clone(),
            rows: of,
        })
    }
}

/// Shared rows, each copied to where it is used.
fn gathered(values: Values) -> Values {
    let Values::Pool {
        width,
        numbers,
        rows,
    } = values
    else {
        return values;
    };
    let mut own = Numbers::with_capacity(numbers.kind(), width * rows.len());
    for row in rows {
        (0..width).for_each(|k| own.push(numbers.get(row as usize * width + k)));
    }
    Values::Rows {
        width,
        numbers: own,
    }
}
