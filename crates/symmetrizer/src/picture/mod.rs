//! Pictures: a small renderer, colour maps, a page builder, the plot of transformation space, and
//! the before/after report.
//!
//! Everything takes plain slices of points and triangles, so nothing here depends on the pipeline.
//! No input panics: triangles with bad indices or coordinates are left out, an empty shape gives
//! an empty picture. The same input gives the same bytes with any number of threads.

pub mod camera;
pub mod canvas;
pub mod checks;
pub mod color;
pub mod density;
pub mod gallery;
mod light;
mod normals;
mod planes;
mod raster;
pub mod render;
pub mod report;
pub mod rods;
pub mod rows;
pub mod sheet;
pub mod stance;
mod svg;
pub mod ticks;
mod visible;

pub use camera::{Camera, View};
pub use canvas::Canvas;
pub use checks::Checks;
pub use color::{ColorMap, ColorScale, categorical};
pub use density::{Axis, DensityPlot, Extent, PlotMode};
pub use gallery::{Exhibit, Gallery};
pub use planes::Tile;
pub use render::{Background, Scene, render};
pub use report::{Panel, ReportPicture};
pub use rods::Rod;
pub use rows::{Cell, Row, Rows};
pub use sheet::{ScalarField, Sheet, render_sheet, strongest};
pub use stance::{Angle, Stance, views_about};
