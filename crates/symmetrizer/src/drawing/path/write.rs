//! Path data, short: absolute or relative numbers, whichever take fewer bytes.

use kurbo::{PathSeg, Point, Vec2};

use super::{Path, Subpath};

/// The value of `d` for `path`, with this many decimals.
pub(in crate::drawing) fn data(path: &Path, decimals: u32) -> String {
    let mut pen = Pen {
        out: String::new(),
        last: ' ',
        at: [0; 2],
        start: [0; 2],
        scale: 10_f64.powi(decimals as i32),
        decimals,
    };
    for subpath in &path.subpaths {
        pen.subpath(subpath);
    }
    pen.out
}

/// How many decimals hold coordinates to within `precision`.
pub(in crate::drawing) fn decimals(precision: f64) -> u32 {
    (-precision.log10()).ceil().clamp(0.0, 12.0) as u32
}

/// A number to this many decimals, as short as it goes.
pub(in crate::drawing) fn number(value: f64, decimals: u32) -> String {
    let scale = 10_f64.powi(decimals as i32);
    shortest(whole(value * scale), decimals)
}

/// A coordinate in units of the last decimal. All that is written is counted in them, so that
/// rounding does not add up along relative commands.
fn whole(value: f64) -> i64 {
    // The limit of coordinates (1e9) and twelve decimals exceed nothing but the precision of f64.
    value.round() as i64
}

fn shortest(value: i64, decimals: u32) -> String {
    let unit = 10_u64.pow(decimals);
    let (size, sign) = (value.unsigned_abs(), if value < 0 { "-" } else { "" });
    let (ones, rest) = (size / unit, size % unit);
    let fraction = if rest == 0 {
        String::new()
    } else {
        let digits = format!("{rest:0width$}", width = decimals as usize);
        format!(".{}", digits.trim_end_matches('0'))
    };
    match ones {
        0 if !fraction.is_empty() => format!("{sign}{fraction}"),
        _ => format!("{sign}{ones}{fraction}"),
    }
}

struct Pen {
    out: String,
    last: char,
    at: [i64; 2],
    start: [i64; 2],
    scale: f64,
    decimals: u32,
}

impl Pen {
    fn subpath(&mut self, subpath: &Subpath) {
        self.start = self.rounded(subpath.start);
        self.command('M', &[self.start]);
        let written = subpath.segments.len() - usize::from(subpath.joined);
        for segment in &subpath.segments[..written] {
            self.segment(segment);
        }
        if subpath.closed {
            self.out.push('z');
            self.last = 'z';
            self.at = self.start;
        }
    }

    fn segment(&mut self, segment: &PathSeg) {
        match segment {
            PathSeg::Line(l) => {
                let to = self.rounded(l.p1);
                if to[1] == self.at[1] {
                    self.single('H', 0, to);
                } else if to[0] == self.at[0] {
                    self.single('V', 1, to);
                } else {
                    self.command('L', &[to]);
                }
            }
            PathSeg::Quad(q) => {
                let points = [self.rounded(q.p1), self.rounded(q.p2)];
                self.command('Q', &points);
            }
            PathSeg::Cubic(c) => {
                let points = [c.p1, c.p2, c.p3].map(|p| self.rounded(p));
                self.command('C', &points);
            }
        }
    }

    fn single(&mut self, letter: char, axis: usize, to: [i64; 2]) {
        let forms = [to[axis], to[axis] - self.at[axis]];
        self.shorter(letter, [vec![forms[0]], vec![forms[1]]]);
        self.at = to;
    }

    fn command(&mut self, letter: char, points: &[[i64; 2]]) {
        let from = self.at;
        let absolute = points.iter().flatten().copied().collect();
        let relative = points.iter().flat_map(|p| [p[0] - from[0], p[1] - from[1]]);
        self.shorter(letter, [absolute, relative.collect()]);
        self.at = points[points.len() - 1];
    }

    /// Appends the shorter of the absolute and the relative form.
    fn shorter(&mut self, letter: char, forms: [Vec<i64>; 2]) {
        let letters = [letter, letter.to_ascii_lowercase()];
        let texts = [0, 1].map(|i| self.form(letters[i], &forms[i]));
        let i = usize::from(texts[1].len() < texts[0].len());
        self.out.push_str(&texts[i]);
        // A further pair after a move is a line.
        self.last = match letters[i] {
            'M' => 'L',
            'm' => 'l',
            other => other,
        };
    }

    fn form(&self, letter: char, numbers: &[i64]) -> String {
        let mut text = String::new();
        let repeated = letter == self.last;
        if !repeated {
            text.push(letter);
        }
        // Whether the number before ends in its fraction, after which a point starts a new one.
        let mut fraction = repeated && self.ends_in_fraction();
        for (i, &n) in numbers.iter().enumerate() {
            let number = shortest(n, self.decimals);
            let apart = number.starts_with('-') || (fraction && number.starts_with('.'));
            if (i > 0 || repeated) && !apart {
                text.push(' ');
            }
            fraction = number.contains('.');
            text.push_str(&number);
        }
        text
    }

    fn ends_in_fraction(&self) -> bool {
        let tail = self.out.rfind(|c: char| !c.is_ascii_digit());
        tail.is_some_and(|i| self.out[i..].starts_with('.'))
    }

    fn rounded(&self, p: Point) -> [i64; 2] {
        let Vec2 { x, y } = p.to_vec2() * self.scale;
        [whole(x), whole(y)]
    }
}
