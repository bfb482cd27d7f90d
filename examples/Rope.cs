// A rope from C#, by P/Invoke on libsinew: for Unity, Godot or MonoGame the declarations are the same.
using System;
using System.Runtime.InteropServices;

static class Sinew
{
    [StructLayout(LayoutKind.Sequential)]
    public struct Simulation { public uint Id; }

    [StructLayout(LayoutKind.Sequential)]
    public struct Point { public double X, Y, Z; }

    [StructLayout(LayoutKind.Sequential)]
    public struct ParticleState
    {
        public uint StructSize;
        public Point Position, Velocity;
        public double InverseMass, Radius;
        public uint Figure, IsAsleep;
    }

    const string Library = "sinew";
    [DllImport(Library)] static extern int sinew_world_open([MarshalAs(UnmanagedType.LPUTF8Str)] string scene, IntPtr options, out Simulation simulation);
    [DllImport(Library)] static extern int sinew_world_step(Simulation simulation, uint count);
    [DllImport(Library)] static extern int sinew_world_find_particle(Simulation simulation, [MarshalAs(UnmanagedType.LPUTF8Str)] string name, out ulong particle);
    [DllImport(Library)] static extern int sinew_world_get_particle(Simulation simulation, ulong particle, ref ParticleState state);
    [DllImport(Library)] static extern int sinew_world_close(Simulation simulation);
    [DllImport(Library)] static extern IntPtr sinew_message();

    static void Check(int status)
    {
        if (status != 0) throw new InvalidOperationException(Marshal.PtrToStringUTF8(sinew_message()));
    }

    public static Simulation Open(string scene)
    {
        Check(sinew_world_open(scene, IntPtr.Zero, out var simulation));
        return simulation;
    }
    public static void Step(Simulation simulation, uint count) => Check(sinew_world_step(simulation, count));
    public static void Close(Simulation simulation) => Check(sinew_world_close(simulation));
    public static Point Position(Simulation simulation, string name)
    {
        Check(sinew_world_find_particle(simulation, name, out var particle));
        var state = new ParticleState { StructSize = (uint)Marshal.SizeOf<ParticleState>() };
        Check(sinew_world_get_particle(simulation, particle, ref state));
        return state.Position;
    }
}

static class Program
{
    static void Main()
    {
        var world = Sinew.Open("{\"sinew\": 1, \"world\": {\"gravity\": [0, -9.81]}, "
            + "\"figures\": [{\"prefab\": \"rope\", \"length\": 2, \"segments\": 20, \"weight\": 5}]}");
        Sinew.Step(world, 600);
        var end = Sinew.Position(world, "rope/end");
        Console.WriteLine($"the weight hangs at ({end.X:F3}, {end.Y:F3})");
        Sinew.Close(world);
    }
}
