-- Ropes to throw about in LÖVE, by LuaJIT's FFI on libsinew:  love examples/love
-- Without LÖVE, `luajit examples/love/main.lua` takes the same steps and prints where the ragdoll is. SINEW names the library.
local ffi = require("ffi")
ffi.cdef [[
typedef struct { uint32_t id; } sinew_world;
typedef struct { double x, y, z; } sinew_point;
typedef struct { uint32_t struct_size; const void* data; uint32_t rows, components, number_bytes, is_integer; } sinew_view;
int sinew_world_open(const char* scene, const void* options, sinew_world* simulation);
int sinew_world_step(sinew_world simulation, uint32_t count);
int sinew_world_get_column(sinew_world simulation, int column, sinew_view* view);
int sinew_world_grab(sinew_world simulation, sinew_point at, double radius);
int sinew_world_drag(sinew_world simulation, sinew_point to);
int sinew_world_let_go(sinew_world simulation);
const char* sinew_message(void);
]]
local sinew = ffi.load(os.getenv("SINEW") or "sinew")
local POSITION, ENDS = 0, 6 -- sinew_column

local function check(status)
    if status ~= 0 then error(ffi.string(sinew.sinew_message())) end
end

-- In pixels, y downwards, as LÖVE has them.
local scene = [==[{"sinew": 1, "units": {"length": "px", "up": "-y"},
  "world": {"gravity": [0, 981], "bounds": {"box": [[0, 0], [800, 600]], "friction": 0.5}},
  "figures": [{"prefab": "rope", "name": "left", "at": [200, 60], "length": 300, "segments": 24, "weight": 3},
              {"prefab": "rope", "name": "right", "at": [600, 60], "length": 260, "segments": 24, "weight": 3},
              {"prefab": "ragdoll", "at": [400, 300]}]}]==]
local world = ffi.new("sinew_world[1]")
check(sinew.sinew_world_open(scene, nil, world))

local function column(number, type)
    local view = ffi.new("sinew_view[1]", { { struct_size = ffi.sizeof("sinew_view") } })
    check(sinew.sinew_world_get_column(world[0], number, view))
    return ffi.cast(type, view[0].data), view[0].rows
end

local function step()
    check(sinew.sinew_world_step(world[0], 1))
end

if not love then
    for _ = 1, 300 do step() end
    local positions, rows = column(POSITION, "const double*")
    local x, y = 0, 0
    for row = 0, rows - 1 do
        x, y = x + positions[2 * row] / rows, y + positions[2 * row + 1] / rows
        assert(positions[2 * row + 1] < 601, "the floor holds")
    end
    print(("300 steps of %d particles, centred at (%.1f, %.1f)"):format(rows, x, y))
    return
end

function love.load()
    love.window.setTitle("Sinew in LÖVE")
end

local owed = 0
function love.update(dt)
    owed = math.min(owed + dt, 0.25)
    while owed >= 1 / 60 do
        step()
        owed = owed - 1 / 60
    end
end

function love.mousepressed(x, y) sinew.sinew_world_grab(world[0], ffi.new("sinew_point", x, y, 0), 30) end
function love.mousemoved(x, y) sinew.sinew_world_drag(world[0], ffi.new("sinew_point", x, y, 0)) end
function love.mousereleased() sinew.sinew_world_let_go(world[0]) end

function love.draw()
    love.graphics.clear(0.96, 0.95, 0.93)
    love.graphics.setColor(0.3, 0.35, 0.45)
    love.graphics.setLineWidth(4)
    local positions = column(POSITION, "const double*")
    local ends, rows = column(ENDS, "const uint32_t*")
    for row = 0, rows / 2 - 1 do
        local a, b = ends[2 * row], ends[2 * row + 1]
        love.graphics.line(positions[2 * a], positions[2 * a + 1], positions[2 * b], positions[2 * b + 1])
    end
end
