//! Vectors, rotations and poses of space.

pub(super) type Vector = [f64; 3];

/// Rows of a matrix of three by three.
pub(super) type Matrix = [[f64; 3]; 3];

pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn plus(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(super) fn minus(a: Vector, b: Vector) -> Vector {
    plus(a, scaled(b, -1.0))
}

pub(super) fn scaled(a: Vector, factor: f64) -> Vector {
    a.map(|entry| factor * entry)
}

/// The vector of length 1 in the same direction; nothing of one that has none.
pub(super) fn unit(a: Vector) -> Option<Vector> {
    let length = dot(a, a).sqrt();
    // A direction along an axis is kept to the digit.
    (length > 1e-12).then(|| if length == 1.0 { a } else { a.map(|entry| entry / length) })
}

/// The matrix that has these entries in its diagonal.
pub(super) fn diagonal([x, y, z]: Vector) -> Matrix {
    [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]]
}

/// The symmetric matrix that has these entries: xx, yy, zz, xy, xz, yz.
pub(super) fn symmetric([x, y, z, xy, xz, yz]: [f64; 6]) -> Matrix {
    [[x, xy, xz], [xy, y, yz], [xz, yz, z]]
}

/// An orthogonal matrix, which turns vectors.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rotation(pub Matrix);

impl Rotation {
    pub const NONE: Self = Self([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);

    /// About an axis of length 1, by an angle in rad.
    pub fn about([x, y, z]: Vector, angle: f64) -> Self {
        let (s, c) = angle.sin_cos();
        let v = 1.0 - c;
        Self([
            [c + v * x * x, v * x * y - s * z, v * x * z + s * y],
            [v * x * y + s * z, c + v * y * y, v * y * z - s * x],
            [v * x * z - s * y, v * y * z + s * x, c + v * z * z],
        ])
    }

    /// Of a quaternion with its scalar first; nothing of one that is zero.
    pub fn of_quaternion(quaternion: [f64; 4]) -> Option<Self> {
        let length = quaternion.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
        let [w, x, y, z] = quaternion.map(|entry| entry / length);
        (length > 1e-12).then_some(Self([
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
            [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
            [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
        ]))
    }

    /// By angles in rad about the axes x, y and z, in this order, which do not turn with it.
    pub fn of_roll_pitch_yaw([roll, pitch, yaw]: [f64; 3]) -> Self {
        Self::about([0.0, 0.0, 1.0], yaw)
            .after(&Self::about([0.0, 1.0, 0.0], pitch))
            .after(&Self::about([1.0, 0.0, 0.0], roll))
    }

    /// The frame with these axes, which are of length 1 and at right angles.
    pub fn of_axes(x: Vector, y: Vector, z: Vector) -> Self {
        Self([x, y, z]).back()
    }

    /// The least turn that brings the z axis into a direction of length 1.
    pub fn from_z_to(direction: Vector) -> Self {
        let z = [0.0, 0.0, 1.0];
        match unit(cross(z, direction)) {
            Some(axis) => Self::about(axis, dot(z, direction).clamp(-1.0, 1.0).acos()),
            None if direction[2] < 0.0 => Self::about([1.0, 0.0, 0.0], std::f64::consts::PI),
            None => Self::NONE,
        }
    }

    pub fn apply(&self, vector: Vector) -> Vector {
        self.0.map(|row| dot(row, vector))
    }

    /// The inverse.
    pub fn back(&self) -> Self {
        let rows = &self.0;
        Self([0, 1, 2].map(|column| [rows[0][column], rows[1][column], rows[2][column]]))
    }

    /// First the other one, then this one.
    pub fn after(&self, first: &Self) -> Self {
        let columns = first.back();
        Self(self.0.map(|row| columns.0.map(|column| dot(row, column))))
    }

    /// A tensor of this frame in the frame around it.
    pub fn tensor(&self, tensor: Matrix) -> Matrix {
        self.after(&Self(tensor)).after(&self.back()).0
    }
}

/// Where a frame is in another one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose {
    pub at: Vector,
    pub turn: Rotation,
}

impl Pose {
    pub const NONE: Self = Self { at: [0.0; 3], turn: Rotation::NONE };

    /// A place of the frame in the one around it.
    pub fn place(&self, place: Vector) -> Vector {
        plus(self.at, self.turn.apply(place))
    }

    /// A frame that is in this one, in the frame around this one.
    pub fn of(&self, inner: &Self) -> Self {
        Self { at: self.place(inner.at), turn: self.turn.after(&inner.turn) }
    }

    /// This frame as another one has it, where both are in the same frame.
    pub fn seen_from(&self, other: &Self) -> Self {
        let back = other.turn.back();
        Self { at: back.apply(minus(self.at, other.at)), turn: back.after(&self.turn) }
    }
}
