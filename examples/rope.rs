// A rope from Rust, by its own FFI:  rustc -L /usr/lib -l sinew rope.rs && ./rope
use std::ffi::{c_char, c_int, c_void, CStr, CString};

#[repr(C)]
#[derive(Clone, Copy)]
struct Simulation {
    id: u32,
}

#[repr(C)]
struct ParticleState {
    struct_size: u32,
    position: [f64; 3],
    velocity: [f64; 3],
    inverse_mass: f64,
    radius: f64,
    figure: u32,
    is_asleep: u32,
}

extern "C" {
    fn sinew_world_open(scene: *const c_char, options: *const c_void, simulation: *mut Simulation) -> c_int;
    fn sinew_world_close(simulation: Simulation) -> c_int;
    fn sinew_world_step(simulation: Simulation, count: u32) -> c_int;
    fn sinew_world_find_particle(simulation: Simulation, name: *const c_char, particle: *mut u64) -> c_int;
    fn sinew_world_get_particle(simulation: Simulation, particle: u64, state: *mut ParticleState) -> c_int;
    fn sinew_message() -> *const c_char;
}

fn check(status: c_int) -> Result<(), String> {
    if status == 0 {
        return Ok(());
    }
    Err(unsafe { CStr::from_ptr(sinew_message()) }.to_string_lossy().into_owned())
}

/// A simulation that is closed when it goes out of scope.
struct World(Simulation);

impl World {
    fn open(scene: &str) -> Result<World, String> {
        let text = CString::new(scene).map_err(|error| error.to_string())?;
        let mut simulation = Simulation { id: 0 };
        check(unsafe { sinew_world_open(text.as_ptr(), std::ptr::null(), &mut simulation) })?;
        Ok(World(simulation))
    }

    fn step(&mut self, count: u32) -> Result<(), String> {
        check(unsafe { sinew_world_step(self.0, count) })
    }

    fn position(&self, name: &str) -> Result<[f64; 3], String> {
        let text = CString::new(name).map_err(|error| error.to_string())?;
        let mut particle = 0;
        let mut state: ParticleState = unsafe { std::mem::zeroed() };
        state.struct_size = std::mem::size_of::<ParticleState>() as u32;
        check(unsafe { sinew_world_find_particle(self.0, text.as_ptr(), &mut particle) })?;
        check(unsafe { sinew_world_get_particle(self.0, particle, &mut state) })?;
        Ok(state.position)
    }
}

impl Drop for World {
    fn drop(&mut self) {
        unsafe { sinew_world_close(self.0) };
    }
}

fn main() -> Result<(), String> {
    let mut world = World::open(
        r#"{"sinew": 1, "world": {"gravity": [0, -9.81]},
            "figures": [{"prefab": "rope", "length": 2, "segments": 20, "weight": 5}]}"#,
    )?;
    world.step(600)?;
    let [x, y, _] = world.position("rope/end")?;
    println!("the weight hangs at ({x:.3}, {y:.3})");
    Ok(())
}
