import type { Text } from "./text.js";

/** Everything the lessons say, in English. Longer texts are HTML; [[term]] and [[shown|term]] explain a word, «mouse|touch» says it for either. */
export const en: Text = {
    language: "English",
    ui: {
        title: "Sinew lessons", coverTitle: "From a point to a ragdoll",
        lead: "Ropes, cloth and people that fall down stairs: all of them are points, and a few rules that are mended again and again. {count} short lessons, each with a figure to drag, one slider that matters, and the program that makes it, yours to change. You need to know what x and y are, and to have written a small program once.",
        begin: "Begin", lesson: "Lesson {number} of {count}", of: "After:", scenes: "scenes", lessons: "lessons", theme: "theme", lightOrDark: "light or dark", otherLanguage: "Deutsch",
        try: "Try:", challenge: "Challenge:", solved: "solved", best: "your best: {value}", restart: "restart", pause: "pause", goOn: "go on", knife: "knife",
        run: "Run", runKey: "Run (Ctrl+Enter)", reset: "Reset", program: "The program that makes it", scene: "The scene file that makes it", edited: "Your own text runs. Reset it to use the slider again.",
        words: "Besides JavaScript there are disc, line, path, arrow, trail, square, write, graph (they draw), held and pointer (the hand), walls, show and say. step(dt) is called 60 times a second, draw() for each picture.",
        line: "line {line}", tooLong: "Stopped: that took longer than two seconds. Is there a loop that never ends?",
        openInPlayground: "open in the playground", takeHome: "Take it home", takeHomeAbout: "One file, no more than 60 lines, no network: open it in a browser and in an editor, and it is yours.", look: "look at it", save: "save",
        toPlayground: "To the playground", neighbours: "Neighbours", figure: "Figure: {title}. Arrow keys move a pointer, Enter presses and lets go.", code: "Code", decimal: ".", failed: "Sinew did not start:",
        printed: "All lessons on one page, to print or to read without JavaScript", glossary: "Words",
        fileTitles: { sticks: "Points and sticks", rope: "A rope and a box", cloth: "A cloth that tears", ragdoll: "A ragdoll", package: "The same man, on Sinew" },
        fileAbouts: {
            sticks: "Your engine so far: points that fall, sticks that hold, walls, and a hand.", rope: "The same with passes and with heavy, light and nailed points.",
            cloth: "Rules with limits, and threads that tear.", ragdoll: "A man of 13 points and 25 rules, on your own engine.", package: "The same skeleton, solved by the package. Put it beside a folder called sinew that holds the package.",
        },
        fileComments: {
            points: "where things are", sticks: "which points hold each other", yours: "this part is yours: build something else", fall: "lesson 1: each point goes on as it went, and falls",
            mend: "lesson 2: each stick gets its length back", wall: "lesson 1: the place before is mirrored, so that it bounces", mobility: "1 / mass; 0 is nailed to the wall", rules: "two points, and how near and how far they may be",
            thread: "a thread may be shorter than 12, not longer", limits: "a rod: low = high; a thread: low = 0; a strut: high = Infinity", tear: "lesson 11: what is too long is gone", rule: "without limits: the distance as it is",
            folder: "of the npm package", solver: "the engine does all that step() did",
        },
    },
    terms: {
        "Verlet integration": "Taking a step with nothing but the place now and the place before: next = now + (now − before) + acceleration · dt².",
        "constraint": "A rule that some points must keep, such as a distance.",
        "iteration": "One pass over all rules. More passes, smaller errors.",
        "substep": "A frame is cut into shorter steps, and each of them is a whole step with its own mending.",
        "inverse mass": "1 / m. How easily a point is moved: 0 for one that cannot be moved at all.",
        "centre of gravity": "The mean place of all mass. No rule inside a figure can move it.",
        "relaxation": "Which share of an error is mended in a pass.",
        "Gauss-Seidel": "Solving equations one after the other, each with the newest values of all others, round and round.",
        "compliance": "How far something gives for each unit of force: 1 / stiffness. Zero is rigid.",
        "XPBD": "Extended position based dynamics: mending places, with a softness that does not depend on the number of passes.",
        "symplectic": "A way of stepping that keeps the areas of all orbits, and so keeps energy near its value for ever.",
        "tether": "A rule that a point is no further from a pin than the way along the threads.",
        "torque": "A force that turns: force times the length of its lever, in newton metres.",
        "de Casteljau": "Finding a point of a curve by mixing again and again.",
        "chaos": "Small differences grow by the same factor in each second, until nothing is alike.",
        "hash": "One number worked out of many, so that any change in them changes it.",
        "damping": "What takes speed away: with 0.5 per second, a second leaves 61 % of the speed.",
    },
    lessons: {
        point: {
            title: "A point falls",
            before: [
                `Everything here is made of points, so begin with one. A point needs to remember only two things: <b>where it is</b> and <b>where it was</b> a moment ago. The difference of the two is how fast it goes. There is no velocity to store.`,
                `To take a step, let the point go on as it went, and add what gravity does in that time. Below the figure is the whole program: change a line, press <b>Run</b>, break it, press <b>Reset</b>.`,
            ],
            figures: [{
                slider: "gravity", task: "Throw the ball. Then turn gravity off with the slider, and then upside down.", reading: "{speed} pixels a second fast",
                challenge: "Throw the ball so that it nearly stands still for a moment in the top quarter of the picture, with gravity pulling down.",
                comments: { gravity: "px/s², downwards", speed: "how far it came in a step", before: "where it was", on: "it goes on as it went", hand: "a hand may move it, too", mirror: "mirror where it was, so that it comes back", back: "and put it on the wall" },
            }],
            after: [
                `This is <b>[[Verlet integration]]</b>. Loup Verlet used it in 1967 to follow atoms of argon; an astronomer, Størmer, had used it sixty years before for northern lights. Its charm: you may <em>move</em> a point, for whatever reason, and the speed mends itself, because speed is only the difference. «Drag it with the mouse|Drag it with a finger», let go, and it is thrown.`,
                `Walls show both sides of this. If a wall only puts the ball back, the ball stays there: the place before is now on the near side, and the next step carries it into the wall again. So the line with the <em>mirror</em> puts the place before on the far side, and the speed is turned around. Its 0.85 is how much of the speed is left; delete the line and look.`,
                `That is the trick of all figures that follow. First points move as if they were alone. Then rules move them to where they are allowed to be.`,
            ],
            questions: [
                ["Why dt·dt, and not half of it?", `School says that in a time t gravity moves you by ½·g·t². That is from rest, in <em>one</em> step. Here each step inherits the speed of the one before, and over many steps the two halves, one from each neighbour, make a whole. Try it: with ½ the ball falls half as far in the same time.`],
                ["Does it depend on the frame rate?", `It does, if you let dt change from step to step: the difference of places is a speed <em>per step</em>. So the program is always stepped 60 times a second, however often your screen shows a picture.`],
            ],
            source: "Verlet 1967; Jakobsen 2001; the idea of placing points comes from all five tutorials that Sinew grew from.",
        },
        stick: {
            title: "Two points and a stick",
            before: [
                `A stick is a promise: <em>these two points are so far from each other</em>. After each step the points have broken it a little. Measure by how much, and move both back along the line between them, half of the error each.`,
                `The arrows are those pushes, drawn 200 times as long as they are.`,
            ],
            figures: [{
                slider: "length", task: "Take one end and swing the other around it: how do the arrows grow? Throw it, so that it tumbles.", reading: "the step left the stick {error} px too long; mended, it is {stretch} off",
                challenge: "Change one number of the program and make a rubber band of the stick: half as long again for a moment.",
                comments: { length: "px", fall: "all of lesson 1", between: "the way from a to b", half: "half of the error", other: "and the other half", enlarged: "200 times as long" },
            }],
            after: [
                `Nobody told the stick how to turn. There is no angle in it and no spin: two points fall, one rule holds them apart, and tumbling comes out of it. Swing it fast and the arrows point inwards, along the stick: that is what your arm feels when you swing a bucket.`,
                `Sinew says the same in a scene file: a [[constraint]] <code>between</code> two particles, with its <code>rest</code> length.`,
            ],
            questions: [
                ["What is theta? And adj, opp, hyp and mid?", `They are only for drawing. <em>adj</em> and <em>opp</em> are how far the stick goes across and down, <em>hyp</em> is its length by Pythagoras, <em>mid</em> the point halfway: where to put the picture of the stick. Theta (θ) is just the Greek letter that people use for an angle. <code>Math.atan2(dy, dx)</code> answers: “if I go dx to the right and dy down, which way do I look?” The physics never asks.`],
                ["Mine stretches without end. I wrote (error − length) / 2.", `Divide: <code>error / now / 2</code>. The line from a to b is as long as the stick. You want a piece of it, half of the error long, so you need the <em>share</em> of the line that this is.`],
                ["How do you understand this? My head is too small.", `Nobody understands it all at once, and nobody has to. Cover the figure and do it with a pencil: two dots, 10 cm apart, that should be 8 cm apart. The error is 2. Move each dot 1 cm towards the other. You have just done every line of the code. All the rest of this course is doing it many times.`],
            ],
            source: "Flash tutorial on Verlet constraints; Jakobsen 2001.",
        },
        split: {
            title: "Who takes the error?",
            before: [`Half each is fair, but not a law. If the first point is heavy, or nailed to the wall, the other must take more. One number tells how the error is split: 0 leaves the first point alone, 1 makes it take everything.`],
            figures: [{
                slider: "share of the red point", task: "The stick is too long at first and shrinks. Where does it end up? Then drag one end.", reading: "red has moved {red} px, yellow {yellow} px", challenge: "Let the red one come to rest 100 px from where it began, to half a pixel.",
                comments: { first: "share of the red point", slowly: "a 25th of the error in each step, to see it happen", itsShare: "the red one takes its share", rest: "the yellow one the rest" },
            }],
            after: [
                `The ends are 400 px apart and should be 130: 270 px have to go. With 25 % the red one moves 67.5 px and the yellow one 202.5. The red one above has moved <output name="red" data-as="tenth">67.5</output> px, the yellow one <output name="yellow" data-as="tenth">202.5</output>.`,
                `In nature the split is not for us to choose: it follows from the masses. Each point moves in proportion to its <b>[[inverse mass]]</b>, 1/m, so that the [[centre of gravity]] stays where it is. A nailed point has inverse mass 0, as if it were infinitely heavy, and needs no special case.`,
                `The Flash tutorial, from which this figure is, lets you choose, which is handy for puppets: a hand that follows the mouse should not be pulled back by the arm.`,
            ],
            source: "Flash tutorial on Verlet constraints: error distribution.",
        },
        integrators: {
            title: "Five ways to take a step",
            before: [`Nothing forces you to step like that. Here are five planets on the same orbit, each moved by another rule, with rather few steps a round. On the right is their energy, which in nature would be a level line.`],
            figures: [{
                slider: "steps a second", task: "Fewer steps make each rule show its character. How few can Verlet live with?", reading: "energy is off by: {errors}",
                choices: ["Euler", "symplectic", "Verlet", "velocity Verlet", "Runge-Kutta"],
                challenge: "Find out with how many steps Runge-Kutta loses what Verlet keeps: a hundredth of the energy more.",
                comments: {
                    rate: "steps a second", old: "the pull where it was", swapped: "the same, but the speed first", noSpeed: "the place now and the place before; no speed", energyOnly: "for the energy only", four: "the pull at four places", sun: "the sun's pull",
                    explicitEuler: "explicit Euler", symplecticEuler: "symplectic Euler", verlet: "Verlet", velocityVerlet: "velocity Verlet", rungeKutta4: "Runge-Kutta 4", energies: "energies",
                },
            }],
            after: [
                `<b>Explicit Euler</b> is what everybody writes first, and the only bad one: it gains energy in each round and leaves. Let the place move <em>after</em> the speed, two lines swapped, and you have <b>[[symplectic]] Euler</b>, which stays for ever. Mind that its pull is still taken at the old place: with the pull at the new place the first rule would be the second in disguise.`,
                `<b>Both Verlets</b> swing about the right energy and never drift: with 20 steps a second they are off by at most 0.6 %, after a minute and after a day. <b>Runge-Kutta</b> is the most exact over a few rounds, at four times the work. But it loses a little each time, and a little for ever is a lot: with 12 steps a second 4 % are gone in two minutes, where Verlet keeps within 1.4 %.`,
            ],
            questions: [["Which one should I use in a game?", `Verlet, if things are tied together, because then you will want to move points by hand. Symplectic Euler otherwise. Both with steps of the same length.`]],
            source: "Hairer, Lubich and Wanner, Geometric Numerical Integration, 2002.",
        },
        triangle: {
            title: "Why triangles are stiff",
            before: [`Three points and three sticks are a triangle, and a triangle cannot change its shape: there is only one triangle with sides of these lengths. More corners, and it can.`],
            figures: [{ slider: "corners", task: "Give it a fourth corner and watch it fold. Pick the heap up by a corner.", reading: "{corners} corners, {ways} ways to move, {sticks} sticks, {needed} needed: {missing} missing", challenge: "Give six corners or more exactly as many sticks as they need: write a comma and <code>\"constraints\": [{\"between\": [\"form/corner_0\", \"form/corner_2\"]}]</code> before the last brace, and add what is missing." }],
            after: [
                `Count: each corner can move in two directions, so n corners have 2n ways to move. Each stick takes one away. Moving the whole thing about takes two and turning it one, so <b>2n − 3</b> sticks make it stiff. For a triangle that is 3, and it has 3. A square has 4, and needs 5. The figure above has <output name="sticks">3</output> sticks and needs <output name="needed">3</output>.`,
                `Bridges, cranes and roofs are triangles for the same reason. With twelve corners and no braces you get a bag, or a chain that is closed.`,
                `From here on some figures are <b>scene files</b> that Sinew runs. They are text as well: change them, and run them.`,
            ],
            source: "Maxwell counted sticks like this in 1864; Flash tutorial on Verlet constraints: triangle.",
        },
        box: {
            title: "A box and its diagonal",
            before: [`Four corners and four sides make a box that falls flat. The stick that was missing is a diagonal. (2 · 4 − 3 = 5.)`],
            figures: [{ slider: "diagonals", choices: ["none", "one", "both"], task: "Throw the box without a diagonal, then with one." }],
            after: [
                `The second diagonal is one stick more than needed. Where all lengths fit, it changes nothing. Where they do not, as with a box whose diagonal was measured wrongly, the sticks quarrel, and some do not get their lengths. Choose one diagonal, write a comma and <code>"constraints": [{"between": ["box/top_right", "box/bottom_left"], "rest": 150}]</code> before the last brace of the file, and run it. Sinew’s box is bent, and lies still; a box of your own shakes, and this is the usual reason.`,
                `The box also tumbles, lands on an edge and rolls over, and again nobody wrote that down.`,
            ],
            questions: [["My box does weird things: it bounces up and down for ever.", `Two usual reasons. The bounce sets the <em>old</em> place too far behind the wall, which gives the point more speed than it had. Or points are moved six times a frame and the sticks only once: then the sticks never catch up. Move and mend the same number of times.`]],
            source: "Roblox developer forum: Verlet integration, and the questions of its readers.",
        },
        iterations: {
            title: "Why iterations?",
            before: [
                `In a rope each point belongs to two sticks. Mend the first, and you have broken the second; mend the second, and the first is wrong again. So you go over all sticks, again and again. Each pass makes the errors smaller, but none makes them zero.`,
                `The curve shows it live: behind your rope hang eight more, with 1, 2, 4 … 128 passes, and each dot is one of them. To the right are the passes, downwards the error that is left, and each line is a tenth of the one above. The large dot is yours.`,
            ],
            figures: [{
                slider: "passes a frame", task: "Begin with one pass: the rope is a rubber band. How many until it looks like rope?", reading: "most stretched stick: {stretch} too long",
                challenge: "Below 1 %, with the fewest passes. Let it come to rest.",
                comments: { passes: "over all sticks", others: "to compare", mobility: "1 / mass", again: "again and again", mend: "lesson 3: by inverse masses", worst: "the longest stick, as a share", yours: "your rope", graph: "error against passes" },
            }],
            after: [
                `Twice the passes leave about half of the error: 8 passes leave 14 %, 16 leave 7 %. A rope with <em>twice</em> as many sticks of half the length needs about <em>four times</em> as many passes to be equally stiff. And a weight ten times as heavy needs about ten times as many. The rope above is now <output name="stretch" data-as="percent">29 %</output> too long with <output name="passes">4</output> passes.`,
                `Mathematicians call this [[Gauss-Seidel]] [[iteration]]; it is from the 19th century, and has always been slow on long chains: what the weight does reaches the nail only one stick further a pass.`,
            ],
            source: "Jakobsen 2001 (relaxation); Seidel 1874.",
        },
        substeps: {
            title: "Why substeps?",
            before: [`You can afford, say, 16 passes a frame. You may go over the sticks 16 times after <em>one</em> step of 1/60 s: that is the rope on the left. Or you take 16 steps of 1/960 s, and go over the sticks <em>once</em> after each: the rope on the right. The sticks are the same, the weights are the same, the work is the same. The ropes are not.`],
            figures: [{
                slider: "passes, or substeps", task: "Double the number, and double it again. Which rope gains more?", reading: "left {left} too long, right {right}",
                challenge: "The rope on the right below 1 %, with the fewest substeps. Let it come to rest.",
                comments: { effort: "how often the sticks are mended in a frame", left: "one step, many passes", right: "many steps, one pass each", air: "the same air for both", passes: "passes", substeps: "substeps" },
            }],
            after: [
                `In a step of half the length a point falls a <em>quarter</em> as far (dt²!), so there is a quarter of the error to mend. Twice the [[substeps|substep]] leave a quarter of the error, where twice the passes leave about half of it: 16 passes leave 4.6 %, 16 substeps 0.31 %; with <output name="effort">4</output> of either the ropes above are <output name="left" data-as="percent">19.5 %</output> and <output name="right" data-as="percent">5.0 %</output> too long. Small steps win, and they also lose less energy.`,
                `Sinew takes 16 substeps in physical mode, unless the figure can be solved exactly: that is another lesson.`,
            ],
            source: "Macklin, Storey, Lu, Terdiman, Chentanez, Jeschke and Müller: Small Steps in Physics Simulation, 2019.",
        },
        chain: {
            title: "A chain, and a limit",
            before: [
                `A chain is sticks in a row. The Godot tutorial mends them once, from the top down, and the lower of two loops takes all of the error: cheap, and it hangs beautifully. But its author saw two faults: a chain that is dragged about gains speed from nowhere, and it can whip right through itself.`,
                `The first is gone when loops share the error by their masses. The second needs a new promise: <em>the angle between two links is at most so large</em>. A limit, not a value.`,
            ],
            figures: [{ slider: "largest angle between links", task: "Fold the chain with 180°, then try the same with 20°." }],
            after: [`The [[constraint]] now measures an angle in place of a distance, and acts only when the angle is too large. Measure something, say between which limits it may be, and how its points move it: that is all that a rule has to say. A rope is a distance of <em>at most</em> L. An elbow is an angle between 0 and 150°.`],
            questions: [["Why does my chain fly off when I drag it?", `Its loops are put where the mouse is, and Verlet reads that as speed. If in the same frame the loop is also moved by its own speed, it is displaced twice, and each frame adds. A held point must forget where it was: set the place before to the place now.`]],
            source: "Godot tutorial on Verlet chains, and its author’s wishes.",
        },
        cloth: {
            title: "Cloth",
            before: [`A cloth is a rope in two directions: a grid of points, threads along and across. Diagonals keep the cells from folding flat, as in the box.`],
            figures: [{ slider: "threads", task: "Drag a corner; «drag beside the cloth to walk around it; the right mouse button cuts|drag beside the cloth to walk around it; the knife below makes your finger cut». How many threads until it looks like cloth?", reading: "{count} points, {rules} rules; most stretched thread: {stretch} too long", choices: ["not even a millionth"] }],
            after: [`With twice as many threads there are four times as many points, and news has twice as far to go. This is where simple solvers give up: a fine cloth sags like chewing gum. Sinew ties each point with a <b>[[tether]]</b> to the corners it hangs on, not longer than the way along the threads. That holds at once.`],
            source: "Provot 1995; Kim, Chentanez and Müller-Fischer: Long Range Attachments, 2012.",
        },
        tearing: {
            title: "Tearing",
            before: [`To tear a cloth, remove a thread that is too long. That is all. The neighbours then carry more, get longer, and tear in turn: a tear runs.`],
            figures: [{ slider: "a thread tears when stretched by", task: "Pull fast. Make it weak, then strong. «The right mouse button cuts.|The knife below makes your finger cut.»", reading: "{torn} threads torn", challenge: "Tear 20 threads of a cloth that lets them stretch by 50 % and more." }],
            after: [
                `All threads of one strength would tear in a straight line, all in one moment. So each thread gets a little extra by chance (<code>uneven</code>), and has to be too long for a little while, since one jerk of the solver is no tear.`,
                `When a piece comes off, nothing special happens to it: it is points and threads that no longer have a way to the rod.`,
            ],
            source: "Curtain, a tearable cloth tutorial for Processing.",
        },
        ragdoll: {
            title: "A ragdoll",
            before: [
                `A man is fourteen points: head and neck, and two each of shoulders, elbows, hands, hips, knees and feet. Bones are sticks between them. Elbows and knees are angles with limits, so that they bend one way only. A hand that is pinned hangs him up.`,
                `Muscles are angles that want a value, but are only so strong: above their largest [[torque]] they give way.`,
            ],
            figures: [{ slider: "largest torque of a muscle", task: "From limp to gymnast: how strong must he be for the cross? Pull him down by a foot.", reading: "the hands are {sag} cm above the shoulders", challenge: "The cross: hands less than 10 cm above the shoulders, with the weakest muscles." }],
            after: [`Old ragdolls had no angles: hidden sticks (a beam from hip to the other shoulder, a rope from knee to knee) kept the limbs apart, and Thomas Jakobsen’s agents of 2000 never crossed their knees because that distance was <em>at least</em> so much. The Roblox tutorial’s man has six such beams. They still work; open <code>ragdoll</code> in the playground and switch it to classic.`],
            questions: [
                ["How do you connect points so that they look like a human?", `Draw a matchstick man on paper and put a dot on every joint: those are the points, and the matches are the sticks. Then look for what would still fold: a trunk of four sticks is a box without a diagonal, so it gets one. Last come the limits, or his knees bend backwards. The drawing on top (shirt, head, shoes) hangs on the points and changes nothing.`],
                ["Where is the code for his collisions?", `There is none for <em>him</em>. Each point is kept out of the wall by itself, the sticks pull the rest along, and so he tumbles, arm over leg. Between two points a stick can still dip into a corner; an engine with shapes, as Sinew has for <code>contact</code>, tests the whole stick.`],
            ],
            source: "Jakobsen, Advanced Character Physics, 2001; Roblox developer forum: ragdolls.",
        },
        bezier: {
            title: "Limbs from three points",
            before: [
                `Three points are an arm: shoulder, elbow, hand. Drawn as two sticks it looks like a robot’s. Drawn as a <b>Bézier curve</b> it is a hose, a tentacle, a cartoon’s arm. The physics is the same; only the pen moves otherwise.`,
                `The curve begins at the shoulder and ends at the hand. It leaves towards the elbow, and arrives from it, but does not go through it. The yellow points show how it is found.`,
            ],
            figures: [{
                slider: "length of the forearm", task: "Move the hand around the elbow. Where does the curve go when the arm is straight? When it is folded?", reading: "t = {t}; the curve passes the elbow {gap} px away", challenge: "Fold the arm until the curve passes the elbow more than 70 px away.",
                comments: { forearm: "px", curve: "t from 0 to 1", upper: "a point on the upper arm", lower: "one as far along the forearm", between: "and one as far between the two", runs: "to and fro, to see it", share: "lesson 3: the share of a" },
            }],
            after: [
                `<code>mix(a, b, t)</code> is the point that lies a share t of the way from a to b. Mixing three times gives a smooth curve: Paul [[de Casteljau]] found it at Citroën in 1959, where they drew cars with it.`,
                `Sixteen samples of t are enough to draw a sleeve. The direction of the curve at t = 1 tells how the hand is turned.`,
            ],
            source: "GameMaker tutorial: Verlet limbs on Bézier curves.",
        },
        compliance: {
            title: "Soft, and how soft",
            before: [
                `To make a stick soft, the tutorials remove only a part of the error in each pass. It works, but <em>how</em> soft it gets depends on the number of passes and of frames: the same scene is stiffer on a faster computer. A spring in the shop has one number, and it is not “0.3 per pass”.`,
                `That number is the <b>[[compliance]]</b>: how far it gives for each unit of force. The stiffness upside down. Zero is rigid.`,
            ],
            figures: [{
                slider: "compliance", task: "Wait until it is at rest, and compare with the yellow line, the formula’s. Then bounce it. Then write another number of substeps.", reading: "should hang {promised} px lower: m · g · compliance; it is {hangs} px lower now",
                challenge: "Let the weight hang 200 px lower, to a pixel.",
                comments: { compliance: "how far for how much force", kilograms: "1 / mass: 2 kg", one: "softness makes the rule give way", air: "the air", promised: "where it should hang" },
            }],
            after: [`A weight of 2 kg pulls with m·g = 1960 kg px/s². Times the compliance, that is how far it hangs: <output name="promised" data-as="one">98</output> px, with any number of substeps, on any machine. The method is called <b>[[XPBD]]</b>. With more than one pass in a step a rule also has to remember the force it has used so far; with one pass, as here, it need not.`],
            source: "Macklin, Müller and Chentanez: XPBD, 2016.",
        },
        rope: {
            title: "Ropes that do not stretch",
            before: [`On the left the tutorials’ rope, with ten passes a frame. On the right Sinew’s, a rope of one kilogram with the weight that you choose. (The tutorials have no masses: on the left all points weigh the same.)`],
            figures: [
                { slider: "weight on the right", task: "Swing both. Make the right one a thousand times heavier than its rope.", reading: "most stretched piece: left {left}, right {right} too long", choices: ["not even a millionth"] },
                {
                    slider: "figure", choices: ["a rope", "a ring", "a net"], task: "Watch the table being solved, line by line. Blue: two sticks share a point. Red: an entry that was empty and had to be filled in. Which figure stays empty?", reading: "{filled} entries filled in, {work} small sums",
                    comments: { shape: "0 a rope, 1 a ring, 2 a net", row: "sticks in a row", net: "n times n points", touches: "they share a point", eliminate: "take stick k out of all others", fill: "two sticks that now have to do with each other" },
                },
            ],
            after: [
                `A sweep passes news from stick to stick, and a heavy weight at the end of light sticks is the worst case: each pass moves the light points and hardly the weight. Ten times the weight needs ten times the passes. The ropes above are now <output name="left" data-as="percent">16.8 %</output> and <output name="right" data-as="percent">0 %</output> too long.`,
                `So Sinew does not sweep a rope at all. All lengths at once are a system of equations: a table in which line i tells how stick i is moved by the forces in all others. For a row of sticks it is nearly empty, since each knows only its neighbours, and it stays empty while it is solved: one way down and one way up, as many steps as there are sticks. A ring fills one line, a net half of the table.`,
                `Figures that hang together like trees, ropes, ragdolls, chains and bridges are solved like this, <em>exactly</em>. Cloth, with its many loops, is swept.`,
            ],
            source: "Cholesky for banded systems, in Goldenthal and others 2007, Deul and others 2018.",
        },
        swing: {
            title: "A swing that keeps swinging",
            before: [`Push a swing without friction, and it should swing for ever, as high each time. Most engines lose a little in each step, and nobody notices, since swings stop anyway. But then the number of steps decides <em>when</em>.`],
            figures: [{ slider: "friction of the air", task: "Leave it alone for a minute with no friction. Then add some: the energy sinks as fast as you say.", reading: "after {seconds} s {left} of the energy are left", bars: ["height", "motion"], challenge: "Half of the energy is left after ten seconds, to a hundredth." }],
            after: [
                `Energy goes to and fro between height and motion: the two bars. Together they should stay as long as they are, and here they do: <output name="left" data-as="percent">100 %</output> are left.`,
                `Verlet’s step keeps energy well; the <em>mending</em> loses it. When the seat is pulled back onto its circle, the pull is that of the end of the step, not of the way there: each such correction comes late, and the longer the step the more it takes. Sinew solves for speeds as well as for places, so what was mended also moves along the circle.`,
                `Friction is then a number of yours, in 1/s: with 0.5 the speed falls to 61 % in a second, on every machine. See [[damping]].`,
            ],
            source: "Hairer, Lubich and Wanner 2002 (SHAKE and RATTLE: Ryckaert 1977, Andersen 1983).",
        },
        determinism: {
            title: "The same, to the last bit",
            before: [`Here are <em>two</em> double pendulums, a red one before a blue one. They start in the same place, to the last bit, and you see only one. Move the slider to let the blue one start a tiny bit to the side: a millionth of a millionth of a pixel, say.`],
            figures: [{ slider: "the blue one starts to the side by", choices: ["nothing", "not apart at all"], task: "With 10⁻¹³ px, when do you see two? And with 10⁻⁶? Press restart: do they ever do something else?", reading: "{steps} steps; {apart}; hash {hash}" }],
            after: [
                `A double pendulum is [[chaotic|chaos]]: here a difference grows tenfold about every 2.4 seconds, until nothing is the same. From 10⁻¹³ px to a hundredth of one are eleven decades, so you see two after some 22 seconds. If two computers differed in the last bit of a single square root, they would soon show another scene. Yet a scene of Sinew ends with the same bits on a phone and on a server, with one thread or eight.`,
                `The price is care: sums in the same order always, no sine from the operating system, and no “fast” arithmetic. The prize: a replay is a list of what was pressed, a bug can be sent in a message, and the address of a scene is enough to show another what you saw. The line below the figure has the [[hash]] of everything that moves.`,
                `Two players far apart can share a world so: <a href="../rollback/">two worlds over a bad link</a>.`,
            ],
            listing: {
                about: "The same in a program, with the package:",
                code: `simulation.restart();
simulation.step(600);
const first = simulation.hash();    // one number over the whole state
simulation.restart();
simulation.step(600);
console.assert(simulation.hash() === first);  // here, and on every machine`,
            },
            questions: [["Is the difference not just rounding?", `It is. Rounding is not random, though: IEEE 754 says what every +, −, ×, ÷ and square root must give, to the last bit. Only order and shortcuts differ, and those a program can choose.`]],
            source: "Lorenz 1963; IEEE 754; Box2D’s and Jolt’s notes on determinism.",
        },
        capstone: {
            title: "Your own engine, and then ours",
            before: [
                `You have everything. Points that fall (1), rules that are mended (2, 3), again and again (7), with limits (9): that is an engine, and the program below is all of it. Its man has 13 points and 25 rules: 12 bones, 6 hidden sticks that hold trunk and head, and 7 distances of <em>at least</em> so much, which keep knees and elbows from folding flat.`,
            ],
            figures: [
                {
                    slider: "passes", task: "Throw him. Then give him a third leg, a tail, or a hat: a line in the table of points, a line in the table of bones.", reading: "most stretched bone: {stretch} too long", challenge: "A man of 14 points or more, with no bone more than 1 % too long for two seconds.",
                    comments: { passes: "passes a step", turning: "thrown up, and turning", hidden: "not drawn: they hold trunk and head", atLeast: "rules that only push apart", one: "lesson 1", two: "and a hand", seven: "lesson 7" },
                },
                { slider: "weight of the head", task: "The same skeleton as a scene file. Make the head a hundred times as heavy as any other point, and lift him by a foot: his bones keep their lengths to a millionth. Your own engine knows no masses yet: give it some, as in lesson 7, and compare.", reading: "most stretched bone: {stretch} too long", choices: ["not even a millionth"] },
            ],
            after: [
                `The second figure is the same man, point for point and rule for rule; only <code>step</code> is Sinew’s. It knows masses, solves his bones exactly, keeps energy, knows the force in each bone, lets him sleep when he lies still, and does the same on every machine. What you have learnt does not change: points, and rules with limits.`,
                `Take both home. Then go to the playground: every scene there is text like this.`,
            ],
            source: "Everything before; Jakobsen 2001.",
        },
    },
};
