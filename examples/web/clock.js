// A step always has the same length, frames do not: the remainder waits for the next frame, and after a stall time is lost.
export class Clock {
    owed = 0;

    /**
     * Takes the steps that are due after so many seconds of real time.
     * @param {import("sinew").Simulation} simulation
     * @param {number} seconds
     */
    advance(simulation, seconds) {
        this.owed = Math.min(this.owed + seconds, 0.25);
        for (; this.owed >= 1 / simulation.rate; this.owed -= 1 / simulation.rate) simulation.step();
    }
}
