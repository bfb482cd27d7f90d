import type { Text } from "./text.js";

/** Alles, was die Lektionen sagen, auf Deutsch. Zeichen wie in en.ts. */
export const de: Text = {
    language: "Deutsch",
    ui: {
        title: "Sinew-Lektionen", coverTitle: "Vom Punkt zur Gliederpuppe",
        lead: "Seile, Stoff und Leute, die Treppen hinunterfallen: Alle sind sie Punkte, und ein paar Regeln, die immer wieder in Ordnung gebracht werden. {count} kurze Lektionen, jede mit einer Figur zum Ziehen, einem Regler, auf den es ankommt, und dem Programm dahinter, das du ändern kannst. Du musst wissen, was x und y sind, und schon einmal ein kleines Programm geschrieben haben.",
        begin: "Anfangen", lesson: "Lektion {number} von {count}", of: "Nach:", scenes: "Szenen", lessons: "Lektionen", theme: "Farben", lightOrDark: "hell oder dunkel", otherLanguage: "English",
        try: "Probier:", challenge: "Aufgabe:", solved: "gelöst", best: "dein bester Wert: {value}", restart: "von vorn", pause: "anhalten", goOn: "weiter", knife: "Messer",
        run: "Los", runKey: "Los (Strg+Enter)", reset: "Zurück", program: "Das Programm dahinter", scene: "Die Szenendatei dahinter", edited: "Es läuft dein eigener Text. „Zurück“ macht den Regler wieder frei.",
        words: "Außer JavaScript gibt es disc, line, path, arrow, trail, square, write, graph (sie zeichnen), held und pointer (die Hand), walls, show und say. step(dt) wird 60-mal in der Sekunde gerufen, draw() für jedes Bild.",
        line: "Zeile {line}", tooLong: "Angehalten: Das hat länger als zwei Sekunden gedauert. Gibt es eine Schleife, die nie endet?",
        openInPlayground: "im Spielplatz öffnen", takeHome: "Zum Mitnehmen", takeHomeAbout: "Eine Datei, höchstens 60 Zeilen, kein Netz: Öffne sie im Browser und im Editor, und sie gehört dir.", look: "ansehen", save: "speichern",
        toPlayground: "Zum Spielplatz", neighbours: "Nachbarn", figure: "Figur: {title}. Pfeiltasten bewegen einen Zeiger, Enter drückt und lässt los.", code: "Programm", decimal: ",", failed: "Sinew ist nicht gestartet:",
        printed: "Alle Lektionen auf einer Seite, zum Drucken oder zum Lesen ohne JavaScript", glossary: "Wörter",
        fileTitles: { sticks: "Punkte und Stäbe", rope: "Ein Seil und eine Kiste", cloth: "Ein Stoff, der reißt", ragdoll: "Eine Gliederpuppe", package: "Derselbe Mann, mit Sinew" },
        fileAbouts: {
            sticks: "Deine Maschine bis hierher: Punkte, die fallen, Stäbe, die halten, Wände und eine Hand.", rope: "Dasselbe mit Durchgängen und mit schweren, leichten und angenagelten Punkten.",
            cloth: "Regeln mit Grenzen und Fäden, die reißen.", ragdoll: "Ein Mann aus 13 Punkten und 25 Regeln, auf deiner eigenen Maschine.", package: "Dasselbe Gerippe, gelöst vom Paket. Leg die Datei neben einen Ordner sinew, der das Paket enthält.",
        },
        fileComments: {
            points: "wo die Dinge sind", sticks: "welche Punkte einander halten", yours: "dieser Teil gehört dir: Bau etwas anderes", fall: "Lektion 1: Jeder Punkt läuft weiter wie bisher, und fällt",
            mend: "Lektion 2: Jeder Stab bekommt seine Länge zurück", wall: "Lektion 1: Der Ort davor wird gespiegelt, damit er zurückprallt", mobility: "1 / Masse; 0 ist an die Wand genagelt", rules: "zwei Punkte, und wie nah und wie fern sie sein dürfen",
            thread: "ein Faden darf kürzer sein als 12, nicht länger", limits: "Stab: low = high; Faden: low = 0; Strebe: high = Infinity", tear: "Lektion 11: Was zu lang ist, ist weg", rule: "ohne Grenzen: der Abstand, wie er ist",
            folder: "des npm-Pakets", solver: "die Maschine tut alles, was step() tat",
        },
    },
    terms: {
        "Verlet-Verfahren": "Ein Schritt nur aus dem Ort jetzt und dem Ort davor: nächster = jetzt + (jetzt − davor) + Beschleunigung · dt².",
        "Bedingung": "Eine Regel, die einige Punkte einhalten müssen, etwa ein Abstand (englisch constraint).",
        "Iteration": "Ein Durchgang über alle Regeln. Mehr Durchgänge, kleinere Fehler.",
        "Teilschritt": "Ein Bild wird in kürzere Schritte zerlegt, und jeder ist ein ganzer Schritt mit eigenem Ausbessern.",
        "inverse Masse": "1 / m. Wie leicht ein Punkt sich bewegen lässt: 0, wenn gar nicht.",
        "Schwerpunkt": "Der mittlere Ort aller Masse. Keine Regel innerhalb einer Figur kann ihn verschieben.",
        "Gauß-Seidel": "Gleichungen eine nach der anderen lösen, jede mit den neuesten Werten aller anderen, reihum.",
        "Nachgiebigkeit": "Wie weit etwas nachgibt für jede Einheit Kraft: 1 / Steifigkeit. Null ist starr.",
        "XPBD": "Erweiterte ortsbasierte Dynamik: Orte ausbessern, mit einer Weichheit, die nicht von der Zahl der Durchgänge abhängt.",
        "symplektisch": "Eine Art zu schreiten, die die Flächen aller Bahnen erhält, und so die Energie für immer nahe ihrem Wert.",
        "Haltefaden": "Eine Regel: Ein Punkt ist von einem Nagel nicht weiter weg als der Weg die Fäden entlang (englisch tether).",
        "Drehmoment": "Eine Kraft, die dreht: Kraft mal Länge ihres Hebels, in Newtonmetern.",
        "de Casteljau": "Einen Punkt einer Kurve finden, indem man immer wieder mischt.",
        "Chaos": "Kleine Unterschiede wachsen in jeder Sekunde um denselben Faktor, bis nichts mehr gleich ist.",
        "Prüfzahl": "Eine Zahl, aus vielen errechnet, sodass jede Änderung an ihnen sie ändert (englisch hash).",
        "Dämpfung": "Was Geschwindigkeit nimmt: Mit 0,5 je Sekunde bleiben nach einer Sekunde 61 %.",
    },
    lessons: {
        point: {
            title: "Ein Punkt fällt",
            before: [
                `Hier besteht alles aus Punkten, also fang mit einem an. Ein Punkt muss sich nur zwei Dinge merken: <b>wo er ist</b> und <b>wo er war</b>, einen Augenblick zuvor. Der Unterschied der beiden ist, wie schnell er läuft. Eine Geschwindigkeit muss niemand speichern.`,
                `Für einen Schritt lass den Punkt weiterlaufen wie bisher, und gib dazu, was die Schwerkraft in dieser Zeit tut. Unter der Figur steht das ganze Programm: Ändere eine Zeile, drück <b>Los</b>, mach es kaputt, drück <b>Zurück</b>.`,
            ],
            figures: [{
                slider: "Schwerkraft", task: "Wirf den Ball. Dann schalte die Schwerkraft mit dem Regler aus, und dann dreh sie um.", reading: "{speed} Pixel in der Sekunde schnell",
                challenge: "Wirf den Ball so, dass er im obersten Viertel des Bildes einen Augenblick fast stillsteht, während die Schwerkraft nach unten zieht.",
                comments: { gravity: "px/s², nach unten", speed: "so weit kam er in einem Schritt", before: "wo er war", on: "er läuft weiter wie bisher", hand: "auch eine Hand darf ihn bewegen", mirror: "spiegle, wo er war, damit er zurückkommt", back: "und setz ihn auf die Wand" },
            }],
            after: [
                `Das ist das <b>[[Verlet-Verfahren]]</b>. Loup Verlet folgte damit 1967 Atomen von Argon; der Astronom Størmer hatte es sechzig Jahre früher für Polarlichter benutzt. Sein Reiz: Du darfst einen Punkt <em>versetzen</em>, aus welchem Grund auch immer, und die Geschwindigkeit stellt sich von selbst ein, denn sie ist nur der Unterschied. «Zieh ihn mit der Maus|Zieh ihn mit dem Finger», lass los, und er fliegt.`,
                `Wände zeigen beide Seiten davon. Setzt eine Wand den Ball nur zurück, dann bleibt er dort: Der Ort davor liegt nun auf der nahen Seite, und der nächste Schritt trägt ihn wieder in die Wand. Also legt die Zeile mit dem <em>Spiegeln</em> den Ort davor auf die andere Seite, und die Geschwindigkeit kehrt um. Ihre 0,85 ist, wie viel davon bleibt; lösch die Zeile und sieh zu.`,
                `Das ist der Trick aller Figuren, die folgen. Zuerst bewegen sich Punkte, als wären sie allein. Dann versetzen Regeln sie dorthin, wo sie sein dürfen.`,
            ],
            questions: [
                ["Warum dt·dt und nicht die Hälfte davon?", `In der Schule bewegt dich die Schwerkraft in der Zeit t um ½·g·t². Das gilt aus der Ruhe, in <em>einem</em> Schritt. Hier erbt jeder Schritt die Geschwindigkeit des vorigen, und über viele Schritte ergeben die beiden Hälften, eine von jedem Nachbarn, ein Ganzes. Probier es: Mit ½ fällt der Ball in derselben Zeit nur halb so weit.`],
                ["Hängt es von der Bildrate ab?", `Ja, wenn du dt von Schritt zu Schritt änderst: Der Unterschied der Orte ist eine Geschwindigkeit <em>je Schritt</em>. Deshalb läuft das Programm immer mit 60 Schritten in der Sekunde, wie oft dein Bildschirm auch ein Bild zeigt.`],
            ],
            source: "Verlet 1967; Jakobsen 2001; die Idee, Punkte zu versetzen, aus allen fünf Anleitungen, aus denen Sinew wuchs.",
        },
        stick: {
            title: "Zwei Punkte und ein Stab",
            before: [
                `Ein Stab ist ein Versprechen: <em>Diese zwei Punkte sind so weit voneinander entfernt.</em> Nach jedem Schritt haben die Punkte es ein wenig gebrochen. Miss, um wie viel, und schieb beide auf der Linie zwischen ihnen zurück, jeden um die Hälfte des Fehlers.`,
                `Die Pfeile sind diese Schübe, 200-mal so lang gezeichnet, wie sie sind.`,
            ],
            figures: [{
                slider: "Länge", task: "Nimm ein Ende und schwing das andere herum: Wie wachsen die Pfeile? Wirf ihn, sodass er taumelt.", reading: "der Schritt ließ den Stab {error} px zu lang; ausgebessert sind es {stretch}",
                challenge: "Ändere eine Zahl im Programm und mach aus dem Stab ein Gummiband: einen Augenblick lang um die Hälfte länger.",
                comments: { length: "px", fall: "die ganze Lektion 1", between: "der Weg von a nach b", half: "die Hälfte des Fehlers", other: "und die andere Hälfte", enlarged: "200-mal so lang" },
            }],
            after: [
                `Niemand hat dem Stab gesagt, wie man sich dreht. Er hat keinen Winkel und keinen Drall: Zwei Punkte fallen, eine Regel hält sie auseinander, und heraus kommt Taumeln. Schwing ihn schnell, und die Pfeile zeigen nach innen, den Stab entlang: Das spürt dein Arm, wenn du einen Eimer schwingst.`,
                `Sinew sagt dasselbe in einer Szenendatei: eine [[Bedingung]] <code>between</code> zwischen zwei Punkten, mit ihrer Länge <code>rest</code>.`,
            ],
            questions: [
                ["Was ist theta? Und adj, opp, hyp und mid?", `Sie sind nur zum Zeichnen da. <em>adj</em> und <em>opp</em> sind, wie weit der Stab zur Seite und nach unten reicht, <em>hyp</em> seine Länge nach Pythagoras, <em>mid</em> die Mitte: wohin das Bild des Stabs kommt. Theta (θ) ist bloß der griechische Buchstabe, den man für Winkel nimmt. <code>Math.atan2(dy, dx)</code> antwortet: „Wenn ich dx nach rechts und dy nach unten gehe, wohin schaue ich?“ Die Physik fragt nie danach.`],
                ["Meiner wird endlos länger. Ich schrieb (error − length) / 2.", `Teile: <code>error / now / 2</code>. Die Linie von a nach b ist so lang wie der Stab. Du willst ein Stück davon, halb so lang wie der Fehler, also brauchst du den <em>Anteil</em> an der Linie.`],
                ["Wie versteht man das? Mein Kopf ist zu klein.", `Niemand versteht alles auf einmal, und niemand muss. Deck die Figur zu und mach es mit dem Bleistift: zwei Punkte, 10 cm auseinander, die 8 cm auseinander sein sollen. Der Fehler ist 2. Verschieb jeden Punkt 1 cm auf den anderen zu. Damit hast du jede Zeile des Programms getan. Der ganze Rest des Kurses tut es nur viele Male.`],
            ],
            source: "Flash-Anleitung zu Verlet-Bedingungen; Jakobsen 2001.",
        },
        split: {
            title: "Wer nimmt den Fehler?",
            before: [`Jeder die Hälfte ist gerecht, aber kein Gesetz. Ist der erste Punkt schwer oder an die Wand genagelt, muss der andere mehr nehmen. Eine Zahl sagt, wie der Fehler geteilt wird: Bei 0 bleibt der erste Punkt in Ruhe, bei 1 nimmt er alles.`],
            figures: [{
                slider: "Anteil des roten Punkts", task: "Der Stab ist zuerst zu lang und schrumpft. Wo kommt er zur Ruhe? Dann zieh an einem Ende.", reading: "rot ist {red} px gewandert, gelb {yellow} px", challenge: "Lass den roten 100 px von seinem Anfang zur Ruhe kommen, auf einen halben Pixel genau.",
                comments: { first: "Anteil des roten Punkts", slowly: "in jedem Schritt ein 25stel des Fehlers, damit man es sieht", itsShare: "der rote nimmt seinen Anteil", rest: "der gelbe den Rest" },
            }],
            after: [
                `Die Enden sind 400 px auseinander und sollen es 130 sein: 270 px müssen weg. Bei 25 % wandert der rote 67,5 px und der gelbe 202,5. Der rote oben ist <output name="red" data-as="tenth">67,5</output> px gewandert, der gelbe <output name="yellow" data-as="tenth">202,5</output>.`,
                `In der Natur dürfen wir das nicht wählen: Es folgt aus den Massen. Jeder Punkt bewegt sich im Verhältnis seiner <b>[[inverse Masse]]</b>, 1/m, und so bleibt der [[Schwerpunkt]], wo er ist. Ein angenagelter Punkt hat die inverse Masse 0, als wäre er unendlich schwer, und braucht keine Ausnahme.`,
                `Die Flash-Anleitung, aus der diese Figur stammt, lässt dich wählen. Für Puppen ist das praktisch: Eine Hand, die der Maus folgt, soll nicht vom Arm zurückgezogen werden.`,
            ],
            source: "Flash-Anleitung zu Verlet-Bedingungen: Verteilung des Fehlers.",
        },
        integrators: {
            title: "Fünf Arten, einen Schritt zu tun",
            before: [`Nichts zwingt dich, so zu schreiten. Hier sind fünf Planeten auf derselben Bahn, jeder nach einer anderen Regel bewegt, mit recht wenigen Schritten je Runde. Rechts ist ihre Energie, in der Natur eine waagrechte Linie.`],
            figures: [{
                slider: "Schritte je Sekunde", task: "Mit weniger Schritten zeigt jede Regel ihren Charakter. Mit wie wenigen kommt Verlet aus?", reading: "Fehler der Energie: {errors}",
                choices: ["Euler", "symplektisch", "Verlet", "Geschwindigkeits-Verlet", "Runge-Kutta"],
                challenge: "Finde heraus, mit wie vielen Schritten Runge-Kutta verliert, was Verlet behält: ein Hundertstel der Energie mehr.",
                comments: {
                    rate: "Schritte je Sekunde", old: "der Zug am alten Ort", swapped: "dasselbe, aber die Geschwindigkeit zuerst", noSpeed: "der Ort jetzt und der Ort davor; keine Geschwindigkeit", energyOnly: "nur für die Energie", four: "der Zug an vier Orten", sun: "der Zug der Sonne",
                    explicitEuler: "expliziter Euler", symplecticEuler: "symplektischer Euler", verlet: "Verlet", velocityVerlet: "Geschw.-Verlet", rungeKutta4: "Runge-Kutta 4", energies: "Energien",
                },
            }],
            after: [
                `Den <b>expliziten Euler</b> schreibt jeder zuerst, und er ist der einzige schlechte: In jeder Runde gewinnt er Energie und zieht davon. Lass den Ort <em>nach</em> der Geschwindigkeit rücken, zwei Zeilen vertauscht, und du hast den <b>[[symplektischen|symplektisch]] Euler</b>, der für immer bleibt. Beachte, dass auch sein Zug am alten Ort genommen wird: Mit dem Zug am neuen Ort wäre die erste Regel die zweite, nur verkleidet.`,
                `<b>Beide Verlets</b> pendeln um die richtige Energie und driften nie: Bei 20 Schritten je Sekunde irren sie um höchstens 0,6 %, nach einer Minute und nach einem Tag. <b>Runge-Kutta</b> ist über wenige Runden der genaueste, bei vierfacher Arbeit. Aber jedes Mal verliert er ein wenig, und ein wenig für immer ist viel: Bei 12 Schritten je Sekunde sind nach zwei Minuten 4 % fort, wo Verlet innerhalb von 1,4 % bleibt.`,
            ],
            questions: [["Welchen nehme ich für ein Spiel?", `Verlet, wenn Dinge aneinander hängen, denn dann willst du Punkte von Hand versetzen. Sonst den symplektischen Euler. Beide mit gleich langen Schritten.`]],
            source: "Hairer, Lubich und Wanner, Geometric Numerical Integration, 2002.",
        },
        triangle: {
            title: "Warum Dreiecke steif sind",
            before: [`Drei Punkte und drei Stäbe sind ein Dreieck, und ein Dreieck kann seine Form nicht ändern: Es gibt nur ein Dreieck mit Seiten dieser Längen. Mit mehr Ecken geht es.`],
            figures: [{ slider: "Ecken", task: "Gib ihm eine vierte Ecke und sieh zu, wie es zusammenklappt. Heb den Haufen an einer Ecke hoch.", reading: "{corners} Ecken, {ways} Bewegungen, {sticks} Stäbe, {needed} nötig: {missing} fehlen", challenge: "Gib sechs Ecken oder mehr genau so viele Stäbe, wie sie brauchen: Schreib ein Komma und <code>\"constraints\": [{\"between\": [\"form/corner_0\", \"form/corner_2\"]}]</code> vor die letzte Klammer, und dazu, was fehlt." }],
            after: [
                `Zähl nach: Jede Ecke kann in zwei Richtungen, also haben n Ecken 2n Bewegungen. Jeder Stab nimmt eine weg. Das Ganze zu verschieben braucht zwei, es zu drehen eine, also machen <b>2n − 3</b> Stäbe es steif. Beim Dreieck sind das 3, und es hat 3. Ein Quadrat hat 4 und braucht 5. Die Figur oben hat <output name="sticks">3</output> Stäbe und braucht <output name="needed">3</output>.`,
                `Brücken, Kräne und Dächer sind aus demselben Grund Dreiecke. Mit zwölf Ecken und ohne Streben bekommst du einen Beutel, oder eine geschlossene Kette.`,
                `Von hier an sind manche Figuren <b>Szenendateien</b>, die Sinew laufen lässt. Auch sie sind Text: Ändere sie, und lass sie laufen.`,
            ],
            source: "So zählte Maxwell 1864 Stäbe; Flash-Anleitung zu Verlet-Bedingungen: Dreieck.",
        },
        box: {
            title: "Eine Kiste und ihre Diagonale",
            before: [`Vier Ecken und vier Seiten sind eine Kiste, die platt fällt. Der fehlende Stab ist eine Diagonale. (2 · 4 − 3 = 5.)`],
            figures: [{ slider: "Diagonalen", choices: ["keine", "eine", "beide"], task: "Wirf die Kiste ohne Diagonale, dann mit einer." }],
            after: [
                `Die zweite Diagonale ist ein Stab mehr als nötig. Wo alle Längen passen, ändert sie nichts. Wo nicht, etwa wenn die Diagonale falsch gemessen wurde, streiten die Stäbe, und manche bekommen ihre Länge nicht. Wähl eine Diagonale, schreib ein Komma und <code>"constraints": [{"between": ["box/top_right", "box/bottom_left"], "rest": 150}]</code> vor die letzte Klammer der Datei, und lass sie laufen. Sinews Kiste wird krumm und liegt still; eine eigene zittert, und das ist der übliche Grund.`,
                `Die Kiste taumelt auch, landet auf einer Kante und rollt ab, und wieder hat das niemand hingeschrieben.`,
            ],
            questions: [["Meine Kiste spinnt: Sie hüpft für immer auf und ab.", `Zwei übliche Gründe. Der Abprall setzt den <em>alten</em> Ort zu weit hinter die Wand, und der Punkt bekommt mehr Geschwindigkeit, als er hatte. Oder Punkte werden sechsmal je Bild bewegt und die Stäbe nur einmal: Dann kommen die Stäbe nie nach. Bewege und bessere gleich oft.`]],
            source: "Roblox-Entwicklerforum: Verlet-Integration, und die Fragen der Leser.",
        },
        iterations: {
            title: "Wozu Iterationen?",
            before: [
                `In einem Seil gehört jeder Punkt zu zwei Stäben. Bessere den ersten aus, und du hast den zweiten kaputt gemacht; bessere den zweiten aus, und der erste stimmt wieder nicht. Also gehst du über alle Stäbe, immer wieder. Jeder Durchgang macht die Fehler kleiner, aber keiner macht sie null.`,
                `Die Kurve zeigt es im Augenblick: Hinter deinem Seil hängen acht weitere, mit 1, 2, 4 … 128 Durchgängen, und jeder Punkt ist eines davon. Nach rechts gehen die Durchgänge, nach unten der Fehler, der bleibt, und jede Linie ist ein Zehntel der darüber. Der große Punkt ist deines.`,
            ],
            figures: [{
                slider: "Durchgänge je Bild", task: "Fang mit einem Durchgang an: Das Seil ist ein Gummiband. Ab wie vielen sieht es nach Seil aus?", reading: "der längste Stab ist {stretch} zu lang",
                challenge: "Unter 1 %, mit den wenigsten Durchgängen. Lass es zur Ruhe kommen.",
                comments: { passes: "über alle Stäbe", others: "zum Vergleich", mobility: "1 / Masse", again: "immer wieder", mend: "Lektion 3: nach inversen Massen", worst: "der längste Stab, als Anteil", yours: "dein Seil", graph: "Fehler und Durchgänge" },
            }],
            after: [
                `Doppelt so viele Durchgänge lassen etwa die Hälfte des Fehlers: 8 lassen 14 %, 16 lassen 7 %. Ein Seil aus <em>doppelt</em> so vielen halb so langen Stäben braucht etwa <em>viermal</em> so viele, um gleich steif zu sein. Und ein zehnmal so schweres Gewicht etwa zehnmal so viele. Das Seil oben ist gerade <output name="stretch" data-as="percent">29 %</output> zu lang, bei <output name="passes">4</output> Durchgängen.`,
                `In der Mathematik heißt das [[Iteration]] nach [[Gauß-Seidel]]; sie ist aus dem 19. Jahrhundert und war an langen Ketten schon immer langsam: Was das Gewicht tut, kommt dem Nagel je Durchgang nur einen Stab näher.`,
            ],
            source: "Jakobsen 2001; Seidel 1874.",
        },
        substeps: {
            title: "Wozu Teilschritte?",
            before: [`Du kannst dir, sagen wir, 16 Durchgänge je Bild leisten. Du kannst nach <em>einem</em> Schritt von 1/60 s 16-mal über die Stäbe gehen: Das ist das Seil links. Oder du tust 16 Schritte von 1/960 s und gehst nach jedem <em>einmal</em> über die Stäbe: das Seil rechts. Die Stäbe sind gleich, die Gewichte sind gleich, die Arbeit ist gleich. Die Seile sind es nicht.`],
            figures: [{
                slider: "Durchgänge oder Teilschritte", task: "Verdopple die Zahl, und noch einmal. Welches Seil gewinnt mehr?", reading: "links {left} zu lang, rechts {right}",
                challenge: "Das rechte Seil unter 1 %, mit den wenigsten Teilschritten. Lass es zur Ruhe kommen.",
                comments: { effort: "wie oft die Stäbe je Bild ausgebessert werden", left: "ein Schritt, viele Durchgänge", right: "viele Schritte, je ein Durchgang", air: "für beide dieselbe Luft", passes: "Durchgänge", substeps: "Teilschritte" },
            }],
            after: [
                `In einem halb so langen Schritt fällt ein Punkt nur ein <em>Viertel</em> so weit (dt²!), also ist ein Viertel des Fehlers auszubessern. Doppelt so viele [[Teilschritte|Teilschritt]] lassen ein Viertel des Fehlers, doppelt so viele Durchgänge etwa die Hälfte: 16 Durchgänge lassen 4,6 %, 16 Teilschritte 0,31 %; bei <output name="effort">4</output> sind die Seile oben <output name="left" data-as="percent">19,5 %</output> und <output name="right" data-as="percent">5,0 %</output> zu lang. Kleine Schritte gewinnen, und sie verlieren auch weniger Energie.`,
                `Sinew tut im physikalischen Modus 16 Teilschritte, außer die Figur lässt sich genau lösen: Das ist eine andere Lektion.`,
            ],
            source: "Macklin, Storey, Lu, Terdiman, Chentanez, Jeschke und Müller: Small Steps in Physics Simulation, 2019.",
        },
        chain: {
            title: "Eine Kette, und eine Grenze",
            before: [
                `Eine Kette ist eine Reihe von Stäben. Die Godot-Anleitung bessert sie einmal aus, von oben nach unten, und das untere von zwei Gliedern nimmt den ganzen Fehler: billig, und sie hängt schön. Aber ihr Autor sah zwei Fehler: Eine Kette, die herumgezogen wird, gewinnt Geschwindigkeit aus dem Nichts, und sie kann durch sich selbst peitschen.`,
                `Der erste ist weg, wenn Glieder den Fehler nach ihren Massen teilen. Der zweite braucht ein neues Versprechen: <em>Der Winkel zwischen zwei Gliedern ist höchstens so groß.</em> Eine Grenze, kein Wert.`,
            ],
            figures: [{ slider: "größter Winkel zwischen Gliedern", task: "Falte die Kette bei 180°, dann versuch dasselbe bei 20°." }],
            after: [`Die [[Bedingung]] misst nun einen Winkel statt eines Abstands und wirkt nur, wenn der Winkel zu groß ist. Miss etwas, sag, zwischen welchen Grenzen es sein darf und wie seine Punkte es ändern: Mehr muss eine Regel nicht sagen. Ein Seil ist ein Abstand von <em>höchstens</em> L. Ein Ellbogen ist ein Winkel zwischen 0 und 150°.`],
            questions: [["Warum fliegt meine Kette davon, wenn ich sie ziehe?", `Ihre Glieder werden dorthin gesetzt, wo die Maus ist, und Verlet liest das als Geschwindigkeit. Wird das Glied im selben Bild auch noch von seiner eigenen bewegt, ist es zweimal versetzt, und jedes Bild legt etwas dazu. Ein gehaltener Punkt muss vergessen, wo er war: Setz den Ort davor auf den Ort jetzt.`]],
            source: "Godot-Anleitung zu Verlet-Ketten, und die Wünsche ihres Autors.",
        },
        cloth: {
            title: "Stoff",
            before: [`Ein Stoff ist ein Seil in zwei Richtungen: ein Gitter aus Punkten, Fäden längs und quer. Diagonalen halten die Zellen davon ab, platt zu klappen, wie bei der Kiste.`],
            figures: [{ slider: "Fäden", task: "Zieh an einer Ecke; «zieh neben dem Stoff, um herumzugehen; die rechte Maustaste schneidet|zieh neben dem Stoff, um herumzugehen; mit dem Messer unten schneidet dein Finger». Ab wie vielen Fäden sieht es nach Stoff aus?", reading: "{count} Punkte, {rules} Regeln; der längste Faden ist {stretch} zu lang", choices: ["nicht einmal ein Millionstel"] }],
            after: [`Mit doppelt so vielen Fäden gibt es viermal so viele Punkte, und Nachrichten haben doppelt so weit zu laufen. Hier geben einfache Löser auf: Feiner Stoff hängt durch wie Kaugummi. Sinew bindet jeden Punkt mit einem <b>[[Haltefaden]]</b> an die Ecken, an denen er hängt, nicht länger als der Weg die Fäden entlang. Das hält sofort.`],
            source: "Provot 1995; Kim, Chentanez und Müller-Fischer: Long Range Attachments, 2012.",
        },
        tearing: {
            title: "Reißen",
            before: [`Um Stoff zu zerreißen, nimm einen Faden weg, der zu lang ist. Das ist alles. Dann tragen die Nachbarn mehr, werden länger und reißen ihrerseits: Ein Riss läuft.`],
            figures: [{ slider: "ein Faden reißt, gedehnt um", task: "Zieh schnell. Mach ihn schwach, dann stark. «Die rechte Maustaste schneidet.|Mit dem Messer unten schneidet dein Finger.»", reading: "{torn} Fäden gerissen", challenge: "Zerreiß 20 Fäden eines Stoffs, der sie um 50 % und mehr dehnen lässt." }],
            after: [
                `Wären alle Fäden gleich stark, rissen sie in gerader Linie, alle im selben Augenblick. Also bekommt jeder Faden durch Zufall etwas dazu (<code>uneven</code>), und er muss eine kleine Weile zu lang sein, denn ein Ruck des Lösers ist noch kein Riss.`,
                `Wenn ein Stück abgeht, geschieht nichts Besonderes mit ihm: Es sind Punkte und Fäden, die keinen Weg mehr zur Stange haben.`,
            ],
            source: "Curtain, eine Anleitung zu reißendem Stoff für Processing.",
        },
        ragdoll: {
            title: "Eine Gliederpuppe",
            before: [
                `Ein Mann ist vierzehn Punkte: Kopf und Hals, und je zwei Schultern, Ellbogen, Hände, Hüften, Knie und Füße. Knochen sind Stäbe zwischen ihnen. Ellbogen und Knie sind Winkel mit Grenzen, damit sie nur in eine Richtung knicken. An einer angenagelten Hand hängt er.`,
                `Muskeln sind Winkel, die einen Wert wollen, aber nur so stark sind: Über ihrem größten [[Drehmoment]] geben sie nach.`,
            ],
            figures: [{ slider: "größtes Drehmoment eines Muskels", task: "Vom Schlaffen zum Turner: Wie stark muss er für den Kreuzhang sein? Zieh ihn an einem Fuß hinunter.", reading: "die Hände sind {sag} cm über den Schultern", challenge: "Der Kreuzhang: die Hände weniger als 10 cm über den Schultern, mit den schwächsten Muskeln." }],
            after: [`Alte Gliederpuppen hatten keine Winkel: Versteckte Stäbe (ein Balken von der Hüfte zur anderen Schulter, ein Seil von Knie zu Knie) hielten die Glieder auseinander, und Thomas Jakobsens Agenten von 2000 überkreuzten nie die Knie, weil dieser Abstand <em>mindestens</em> so groß war. Der Mann der Roblox-Anleitung hat sechs solche Balken. Sie wirken noch immer; öffne <code>ragdoll</code> im Spielplatz und schalte auf classic.`],
            questions: [
                ["Wie verbindet man Punkte, damit sie wie ein Mensch aussehen?", `Zeichne ein Strichmännchen auf Papier und mach einen Punkt auf jedes Gelenk: Das sind die Punkte, die Striche sind die Stäbe. Dann such, was noch klappt: Ein Rumpf aus vier Stäben ist eine Kiste ohne Diagonale, also bekommt er eine. Zuletzt kommen die Grenzen, sonst knicken die Knie nach hinten. Die Zeichnung darüber (Hemd, Kopf, Schuhe) hängt an den Punkten und ändert nichts.`],
                ["Wo ist das Programm für seine Zusammenstöße?", `Für <em>ihn</em> gibt es keines. Jeder Punkt wird für sich aus der Wand gehalten, die Stäbe ziehen den Rest mit, und so taumelt er, Arm über Bein. Zwischen zwei Punkten kann ein Stab noch in eine Ecke tauchen; eine Maschine mit Formen, wie Sinew sie für <code>contact</code> hat, prüft den ganzen Stab.`],
            ],
            source: "Jakobsen, Advanced Character Physics, 2001; Roblox-Entwicklerforum: Gliederpuppen.",
        },
        bezier: {
            title: "Glieder aus drei Punkten",
            before: [
                `Drei Punkte sind ein Arm: Schulter, Ellbogen, Hand. Als zwei Stäbe gezeichnet sieht er nach Roboter aus. Als <b>Bézierkurve</b> ist er ein Schlauch, ein Fangarm, ein Arm aus einem Zeichentrickfilm. Die Physik ist dieselbe; nur der Stift läuft anders.`,
                `Die Kurve beginnt an der Schulter und endet an der Hand. Sie läuft auf den Ellbogen los und kommt von ihm her, geht aber nicht hindurch. Die gelben Punkte zeigen, wie man sie findet.`,
            ],
            figures: [{
                slider: "Länge des Unterarms", task: "Führ die Hand um den Ellbogen. Wo läuft die Kurve bei gestrecktem Arm? Und bei gefaltetem?", reading: "t = {t}; die Kurve geht {gap} px am Ellbogen vorbei", challenge: "Falte den Arm, bis die Kurve mehr als 70 px am Ellbogen vorbeigeht.",
                comments: { forearm: "px", curve: "t von 0 bis 1", upper: "ein Punkt auf dem Oberarm", lower: "einer ebenso weit auf dem Unterarm", between: "und einer ebenso weit zwischen beiden", runs: "hin und her, damit man es sieht", share: "Lektion 3: der Anteil von a" },
            }],
            after: [
                `<code>mix(a, b, t)</code> ist der Punkt, der um den Anteil t des Wegs von a nach b liegt. Dreimal gemischt ergibt eine glatte Kurve: Paul [[de Casteljau]] fand es 1959 bei Citroën, wo man damit Autos zeichnete.`,
                `Sechzehn Werte von t genügen für einen Ärmel. Die Richtung der Kurve bei t = 1 sagt, wie die Hand gedreht ist.`,
            ],
            source: "GameMaker-Anleitung: Verlet-Glieder auf Bézierkurven.",
        },
        compliance: {
            title: "Weich, und wie weich",
            before: [
                `Um einen Stab weich zu machen, nehmen die Anleitungen in jedem Durchgang nur einen Teil des Fehlers weg. Das geht, aber <em>wie</em> weich er wird, hängt von der Zahl der Durchgänge und der Bilder ab: Dieselbe Szene ist auf einem schnelleren Rechner steifer. Eine Feder im Laden hat eine Zahl, und die ist nicht „0,3 je Durchgang“.`,
                `Diese Zahl ist die <b>[[Nachgiebigkeit]]</b>: wie weit sie nachgibt für jede Einheit Kraft. Die umgekehrte Steifigkeit. Null ist starr.`,
            ],
            figures: [{
                slider: "Nachgiebigkeit", task: "Warte, bis es ruht, und vergleich mit der gelben Linie, der Formel. Dann lass es hüpfen. Dann schreib eine andere Zahl von Teilschritten.", reading: "soll {promised} px tiefer hängen: m · g · Nachgiebigkeit; hängt jetzt {hangs} px tiefer",
                challenge: "Lass das Gewicht 200 px tiefer hängen, auf einen Pixel genau.",
                comments: { compliance: "wie weit für wie viel Kraft", kilograms: "1 / Masse: 2 kg", one: "Weichheit lässt die Regel nachgeben", air: "die Luft", promised: "wo es hängen soll" },
            }],
            after: [`Ein Gewicht von 2 kg zieht mit m·g = 1960 kg px/s². Mal Nachgiebigkeit, und du weißt, wie tief es hängt: <output name="promised" data-as="one">98</output> px, mit jeder Zahl von Teilschritten, auf jedem Rechner. Das Verfahren heißt <b>[[XPBD]]</b>. Mit mehr als einem Durchgang je Schritt muss eine Regel sich auch merken, wie viel Kraft sie schon verbraucht hat; mit einem, wie hier, nicht.`],
            source: "Macklin, Müller und Chentanez: XPBD, 2016.",
        },
        rope: {
            title: "Seile, die sich nicht dehnen",
            before: [`Links das Seil der Anleitungen, mit zehn Durchgängen je Bild. Rechts das von Sinew, ein Seil von einem Kilogramm mit dem Gewicht, das du wählst. (Die Anleitungen kennen keine Massen: Links wiegen alle Punkte gleich viel.)`],
            figures: [
                { slider: "Gewicht rechts", task: "Schwing beide. Mach das rechte tausendmal schwerer als sein Seil.", reading: "längstes Stück: links {left}, rechts {right} zu lang", choices: ["nicht einmal ein Millionstel"] },
                {
                    slider: "Figur", choices: ["ein Seil", "ein Ring", "ein Netz"], task: "Sieh zu, wie die Tabelle gelöst wird, Zeile um Zeile. Blau: Zwei Stäbe teilen einen Punkt. Rot: ein leeres Feld, das gefüllt werden musste. Welche Figur bleibt leer?", reading: "{filled} Felder gefüllt, {work} kleine Rechnungen",
                    comments: { shape: "0 ein Seil, 1 ein Ring, 2 ein Netz", row: "Stäbe in einer Reihe", net: "n mal n Punkte", touches: "sie teilen einen Punkt", eliminate: "nimm Stab k aus allen anderen", fill: "zwei Stäbe, die nun miteinander zu tun haben" },
                },
            ],
            after: [
                `Durchgänge tragen Nachrichten von Stab zu Stab, und ein schweres Gewicht am Ende leichter Stäbe ist der schlimmste Fall: Jeder Durchgang bewegt die leichten Punkte und kaum das Gewicht. Zehnfaches Gewicht braucht zehnmal so viele Durchgänge. Die Seile oben sind gerade <output name="left" data-as="percent">16,8 %</output> und <output name="right" data-as="percent">0 %</output> zu lang.`,
                `Deshalb geht Sinew über ein Seil gar nicht reihum. Alle Längen zusammen sind ein Gleichungssystem: eine Tabelle, in der Zeile i sagt, wie Stab i von den Kräften in allen anderen bewegt wird. Für eine Reihe von Stäben ist sie fast leer, denn jeder kennt nur seine Nachbarn, und sie bleibt beim Lösen leer: einmal hinunter und einmal hinauf, so viele Schritte wie Stäbe. Ein Ring füllt eine Zeile, ein Netz die halbe Tabelle.`,
                `Figuren, die wie Bäume zusammenhängen, Seile, Gliederpuppen, Ketten und Brücken, werden so gelöst, <em>genau</em>. Stoff mit seinen vielen Schleifen wird in Durchgängen ausgebessert.`,
            ],
            source: "Cholesky für Bandmatrizen, in Goldenthal und andere 2007, Deul und andere 2018.",
        },
        swing: {
            title: "Eine Schaukel, die nicht müde wird",
            before: [`Stoß eine Schaukel ohne Reibung an, und sie sollte ewig schwingen, jedes Mal gleich hoch. Die meisten Maschinen verlieren in jedem Schritt ein wenig, und niemand merkt es, denn Schaukeln hören sowieso auf. Aber dann entscheidet die Zahl der Schritte, <em>wann</em>.`],
            figures: [{ slider: "Reibung der Luft", task: "Lass sie eine Minute ohne Reibung allein. Dann gib etwas dazu: Die Energie sinkt so schnell, wie du sagst.", reading: "nach {seconds} s sind {left} der Energie übrig", bars: ["Höhe", "Bewegung"], challenge: "Nach zehn Sekunden ist die Hälfte der Energie übrig, auf ein Hundertstel genau." }],
            after: [
                `Energie wandert zwischen Höhe und Bewegung hin und her: die beiden Balken. Zusammen sollten sie so lang bleiben, wie sie sind, und das tun sie: <output name="left" data-as="percent">100 %</output> sind übrig.`,
                `Verlets Schritt behält Energie gut; das <em>Ausbessern</em> verliert sie. Wird der Sitz auf seinen Kreis zurückgezogen, ist der Zug der vom Ende des Schritts, nicht der vom Weg dorthin: Jede solche Korrektur kommt zu spät, und je länger der Schritt, desto mehr nimmt sie. Sinew löst auch nach Geschwindigkeiten, und so läuft das Ausgebesserte auch den Kreis entlang.`,
                `Reibung ist dann eine Zahl von dir, in 1/s: Mit 0,5 fällt die Geschwindigkeit in einer Sekunde auf 61 %, auf jedem Rechner. Siehe [[Dämpfung]].`,
            ],
            source: "Hairer, Lubich und Wanner 2002 (SHAKE und RATTLE: Ryckaert 1977, Andersen 1983).",
        },
        determinism: {
            title: "Dasselbe, bis zum letzten Bit",
            before: [`Hier sind <em>zwei</em> Doppelpendel, ein rotes vor einem blauen. Sie beginnen am selben Ort, bis zum letzten Bit, und du siehst nur eines. Mit dem Regler beginnt das blaue ein winziges Stück daneben: ein Millionstel eines Millionstels eines Pixels, zum Beispiel.`],
            figures: [{ slider: "das blaue beginnt daneben um", choices: ["nichts", "kein Abstand"], task: "Wann siehst du bei 10⁻¹³ px zwei? Und bei 10⁻⁶? Drück auf „von vorn“: Tun sie je etwas anderes?", reading: "{steps} Schritte; {apart}; Prüfzahl {hash}" }],
            after: [
                `Ein Doppelpendel ist [[chaotisch|Chaos]]: Hier wächst ein Unterschied etwa alle 2,4 Sekunden auf das Zehnfache, bis nichts mehr gleich ist. Von 10⁻¹³ px bis zu einem Hundertstel sind es elf Zehnerpotenzen, also siehst du nach etwa 22 Sekunden zwei. Unterschieden sich zwei Rechner im letzten Bit einer einzigen Wurzel, zeigten sie bald andere Szenen. Eine Szene von Sinew aber endet mit denselben Bits auf einem Telefon und auf einem Server, mit einem Faden der Arbeit oder acht.`,
                `Der Preis ist Sorgfalt: Summen immer in derselben Reihenfolge, kein Sinus des Betriebssystems, keine „schnelle“ Arithmetik. Der Gewinn: Eine Aufzeichnung ist eine Liste dessen, was gedrückt wurde, ein Fehler passt in eine Nachricht, und die Adresse einer Szene zeigt anderen, was du sahst. Die Zeile unter der Figur hat die [[Prüfzahl]] von allem, was sich bewegt.`,
                `So teilen sich zwei Spieler, die weit voneinander sitzen, eine Welt: <a href="../rollback/" hreflang="en">zwei Welten über eine schlechte Leitung</a>.`,
            ],
            listing: {
                about: "Dasselbe in einem Programm, mit dem Paket:",
                code: `simulation.restart();
simulation.step(600);
const first = simulation.hash();    // eine Zahl über den ganzen Zustand
simulation.restart();
simulation.step(600);
console.assert(simulation.hash() === first);  // hier, und auf jedem Rechner`,
            },
            questions: [["Ist der Unterschied nicht bloß Rundung?", `Doch. Aber Rundung ist nicht zufällig: IEEE 754 sagt, was jedes +, −, ×, ÷ und jede Wurzel ergeben muss, bis zum letzten Bit. Nur Reihenfolge und Abkürzungen machen Unterschiede, und die kann ein Programm wählen.`]],
            source: "Lorenz 1963; IEEE 754; die Notizen von Box2D und Jolt zum Determinismus.",
        },
        capstone: {
            title: "Deine eigene Maschine, und dann unsere",
            before: [`Du hast alles. Punkte, die fallen (1), Regeln, die ausgebessert werden (2, 3), immer wieder (7), mit Grenzen (9): Das ist eine Maschine, und das Programm unten ist alles davon. Ihr Mann hat 13 Punkte und 25 Regeln: 12 Knochen, 6 versteckte Stäbe, die Rumpf und Kopf halten, und 7 Abstände von <em>mindestens</em> so viel, damit Knie und Ellbogen nicht platt klappen.`],
            figures: [
                {
                    slider: "Durchgänge", task: "Wirf ihn. Dann gib ihm ein drittes Bein, einen Schwanz oder einen Hut: eine Zeile in der Tabelle der Punkte, eine in der Tabelle der Knochen.", reading: "der längste Knochen ist {stretch} zu lang", challenge: "Ein Mann aus 14 Punkten oder mehr, bei dem zwei Sekunden lang kein Knochen mehr als 1 % zu lang ist.",
                    comments: { passes: "Durchgänge je Schritt", turning: "hochgeworfen, und gedreht", hidden: "nicht gezeichnet: Sie halten Rumpf und Kopf", atLeast: "Regeln, die nur auseinanderdrücken", one: "Lektion 1", two: "und eine Hand", seven: "Lektion 7" },
                },
                { slider: "Gewicht des Kopfs", task: "Dasselbe Gerippe als Szenendatei. Mach den Kopf hundertmal so schwer wie jeden anderen Punkt, und heb ihn an einem Fuß hoch: Seine Knochen bleiben so lang, wie sie sind, auf ein Millionstel. Deine eigene Maschine kennt noch keine Massen: Gib ihr welche, wie in Lektion 7, und vergleich.", reading: "der längste Knochen ist {stretch} zu lang", choices: ["nicht einmal ein Millionstel"] },
            ],
            after: [
                `Die zweite Figur ist derselbe Mann, Punkt für Punkt und Regel für Regel; nur <code>step</code> ist von Sinew. Es kennt Massen, löst seine Knochen genau, behält die Energie, kennt die Kraft in jedem Knochen, lässt ihn schlafen, wenn er still liegt, und tut auf jedem Rechner dasselbe. Was du gelernt hast, ändert sich nicht: Punkte, und Regeln mit Grenzen.`,
                `Nimm beide mit. Dann geh auf den Spielplatz: Jede Szene dort ist Text wie dieser.`,
            ],
            source: "Alles davor; Jakobsen 2001.",
        },
    },
};
