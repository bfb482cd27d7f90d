// The worker's side: a frame is asked for with the number of steps and the pointer, and answered with what there is to paint.
self.onmessage = ({ data }) => {
    for (const [name, value] of Object.entries(data.values ?? {})) lessonProgram.values[name]?.(value);
    Object.assign(lessonPointer, data.pointer);
    try {
        postMessage(lessonFrame(lessonProgram, data.steps));
    } catch (error) {
        postMessage({ error: String(error?.message ?? error), stack: String(error?.stack ?? "") });
    }
};
postMessage({ isReady: true });
