//! What detection looks for: kinds of isometries, and continuous symmetries.

use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};
use crate::transform::{Class, Kind};

/// Something to look for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Want {
    /// Reflections in a plane.
    Mirror,
    /// Turns about an axis.
    Rotation,
    /// Shifts.
    Translation,
    /// Turns with a shift along the axis.
    Screw,
    /// Reflections with a shift along the plane.
    Glide,
    /// Turns with the reflection across the axis.
    Rotoreflection,
    /// Reflections in a point.
    Inversion,
    /// Parts that slide along themselves.
    Continuous,
}

/// All that is looked for.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Wanted {
    /// The kinds.
    pub kinds: Vec<Want>,
}

impl Default for Wanted {
    fn default() -> Self {
        Self {
            kinds: Want::ALL.to_vec(),
        }
    }
}

impl Want {
    /// Everything there is to look for.
    pub const ALL: [Self; 8] = [
        Self::Mirror,
        Self::Rotation,
        Self::Translation,
        Self::Screw,
        Self::Glide,
        Self::Rotoreflection,
        Self::Inversion,
        Self::Continuous,
    ];

    /// The name in parameters and on the command line: that of the [`Kind`], or `continuous`.
    pub fn name(self) -> &'static str {
        self.kind().map_or("continuous", Kind::name)
    }

    /// The kind of isometry; none for continuous symmetries.
    pub fn kind(self) -> Option<Kind> {
        match self {
            Self::Mirror => Some(Kind::Mirror),
            Self::Rotation => Some(Kind::Rotation),
            Self::Translation => Some(Kind::Translation),
            Self::Screw => Some(Kind::Screw),
            Self::Glide => Some(Kind::Glide),
            Self::Rotoreflection => Some(Kind::Rotoreflection),
            Self::Inversion => Some(Kind::Inversion),
            Self::Continuous => None,
        }
    }

    /// The names of everything, with commas.
    pub fn names() -> String {
        Self::ALL.map(Self::name).join(", ")
    }
}

impl std::str::FromStr for Want {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self> {
        let found = Self::ALL.into_iter().find(|want| want.name() == name);
        found.ok_or_else(|| {
            let what = format!("there is no {name:?}; there are {}", Self::names());
            Error::params("detect.kinds", what)
        })
    }
}

impl Wanted {
    /// Mirrors alone.
    pub fn mirrors() -> Self {
        Self {
            kinds: vec![Want::Mirror],
        }
    }

    /// Of these what there is in the plane.
    pub fn in_plane(&self) -> Self {
        use Want::{Glide, Mirror, Rotation, Translation};
        let there = [Mirror, Rotation, Translation, Glide];
        let mut wanted = self.clone();
        wanted.kinds.retain(|want| there.contains(want));
        wanted
    }

    /// Whether isometries of `kind` are looked for.
    pub fn has(&self, kind: Kind) -> bool {
        self.kinds.iter().any(|want| want.kind() == Some(kind))
    }

    /// Whether parts that slide along themselves are looked for.
    pub fn continuous(&self) -> bool {
        self.kinds.contains(&Want::Continuous)
    }

    /// The clouds that have the kinds wanted, mirrors first.
    pub fn classes(&self) -> Vec<Class> {
        let improper = [Kind::Glide, Kind::Rotoreflection, Kind::Inversion];
        let proper = [Kind::Rotation, Kind::Translation, Kind::Screw];
        let any = |kinds: &[Kind]| kinds.iter().any(|&kind| self.has(kind));
        let wanted = |class: &Class| match class {
            Class::Mirror => self.has(Kind::Mirror),
            Class::Proper => any(&proper),
            Class::Improper => any(&improper),
        };
        Class::ALL.into_iter().filter(wanted).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_kinds_everywhere() {
        for want in Want::ALL {
            assert_eq!(want.name().parse::<Want>().unwrap(), want);
            assert_eq!(serde_json::to_value(want).unwrap(), want.name());
        }
        for kind in Kind::ALL {
            let wanted = Wanted::default().has(kind);
            assert_eq!(wanted, kind != Kind::Identity, "{kind}");
        }
        let error = "spiral".parse::<Want>().unwrap_err().to_string();
        assert!(
            error.contains("\"spiral\"") && error.contains("glide"),
            "{error}"
        );
    }

    #[test]
    fn a_kind_asks_for_its_cloud_only() {
        let classes = |kinds: &[Want]| {
            let kinds = kinds.to_vec();
            Wanted { kinds }.classes()
        };
        assert_eq!(Wanted::default().classes(), Class::ALL);
        assert_eq!(Wanted::mirrors().classes(), [Class::Mirror]);
        assert_eq!(classes(&[Want::Screw]), [Class::Proper]);
        let both = [Want::Inversion, Want::Mirror, Want::Glide];
        assert_eq!(classes(&both), [Class::Mirror, Class::Improper]);
        assert_eq!(classes(&[Want::Continuous]), []);
    }
}
