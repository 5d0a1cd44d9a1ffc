//! Numbers of the type that the file gives them.

/// The type of a [`Numbers`] list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// 8-bit signed.
    I8,
    /// 8-bit unsigned.
    U8,
    /// 16-bit signed.
    I16,
    /// 16-bit unsigned.
    U16,
    /// 32-bit signed.
    I32,
    /// 32-bit unsigned.
    U32,
    /// Single precision.
    F32,
    /// Double precision.
    F64,
}

macro_rules! numbers {
    ($($variant:ident $type:ty),*) => {
        /// A list of numbers of one type. All of them fit in an `f64` without loss.
        #[derive(Debug, Clone, PartialEq)]
        pub enum Numbers {
            $(#[doc = concat!("As `", stringify!($type), "`.")]
            $variant(Vec<$type>)),*
        }

        impl Numbers {
            /// An empty list of a type, with room for `capacity` numbers.
            pub fn with_capacity(kind: Kind, capacity: usize) -> Self {
                match kind { $(Kind::$variant => Self::$variant(Vec::with_capacity(capacity))),* }
            }

            /// The type.
            pub fn kind(&self) -> Kind {
                match self { $(Self::$variant(_) => Kind::$variant),* }
            }

            /// How many numbers there are.
            pub fn len(&self) -> usize {
                match self { $(Self::$variant(v) => v.len()),* }
            }

            /// Number `i`.
            pub fn get(&self, i: usize) -> f64 {
                match self { $(Self::$variant(v) => f64::from(v[i])),* }
            }

            /// Replaces number `i` by `value`, rounded to the type.
            pub fn set(&mut self, i: usize, value: f64) {
                match self { $(Self::$variant(v) => v[i] = rounded!($variant, value) as $type),* }
            }

            /// Appends `value`, rounded to the type.
            pub fn push(&mut self, value: f64) {
                match self { $(Self::$variant(v) => v.push(rounded!($variant, value) as $type)),* }
            }
        }
    };
}

/// Casts to whole numbers cut, so these are rounded first.
macro_rules! rounded {
    (F32, $value:expr) => {
        $value
    };
    (F64, $value:expr) => {
        $value
    };
    ($whole:ident, $value:expr) => {
        $value.round()
    };
}

numbers!(I8 i8, U8 u8, I16 i16, U16 u16, I32 i32, U32 u32, F32 f32, F64 f64);

impl Numbers {
    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// All numbers in order.
    pub fn iter(&self) -> impl Iterator<Item = f64> {
        (0..self.len()).map(|i| self.get(i))
    }
}

impl Kind {
    /// Whether it holds fractions.
    pub fn is_float(self) -> bool {
        matches!(self, Self::F32 | Self::F64)
    }
}
