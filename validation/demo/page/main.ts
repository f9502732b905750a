// The page: from a change of the situation to the requests, and from their answers to the panels.
import type { ExplainAnswer, SequenceAnswer, SimulateAnswer } from "./answers";
import { Latest, isAvailable, isOffline } from "./api";
import { CONTINUOUS_RADIUS, type Body } from "./body";
import { EnergyBars, ForceChart } from "./charts";
import { ContinuousMotion } from "./continuous_motion";
import { Controls } from "./controls";
import { DiscreteMotion } from "./discrete_motion";
import { byId } from "./dom";
import { Explanation } from "./explain";
import { frameAt, impactAt, scalesOf, type Motions, type Scales } from "./frame";
import { AngleMap } from "./map";
import { Numbers } from "./numbers";
import { goOffline, hidePanels, setUpLayout } from "./panels";
import { Player, TimeWarp } from "./playback";
import { Prediction } from "./prediction";
import { explainRequest, gravityNumber, keyOf, sequenceRequest, simulateRequest } from "./requests";
import { firstSpeed } from "./restitution";
import { setUpSharing } from "./sharing";
import { Stage } from "./stage";
import { bodyOf, readAddress, writeAddress, type Parameters, type State } from "./state";
import { ImpactTable, csvOf, download } from "./table";
import { Transport } from "./transport";
import { impactInWords, outcomeInWords } from "./words";

/** Until a situation stands still for so long, the slower model is not asked [ms]. */
const CONTINUOUS_DELAY = 150;
const EXPLAIN_DELAY = 80;
const PLAY_DELAY = 350;

class Page {
  private readonly state: State = readAddress();
  private readonly motions: Motions = { discrete: null, continuous: null };
  private answer: SequenceAnswer | null = null;
  private continuous: SimulateAnswer | null = null;
  private scales: Scales = scalesOf({ discrete: null, continuous: null });
  private asked = 0;
  /** Until the first answer the time is that of the link. */
  private hasShown = false;
  /** Whether the time is that of the chosen impact, or one that was sought. */
  private followsImpact = false;
  /** Of which situation the continuous model's answer is. */
  private continuousOf = "";
  /** Which situation it refused last. */
  private refusedOf = "";
  private playTimer = 0;

  private readonly stage = new Stage();
  private readonly numbers = new Numbers();
  private readonly energy = new EnergyBars();
  private readonly force = new ForceChart();
  private readonly explanation = new Explanation();
  private readonly table = new ImpactTable((n) => this.goTo(n));
  private readonly map = new AngleMap((angle) => this.setAngle(angle));
  private readonly player = new Player(new TimeWarp(0, 1, [], false), () => this.onTime());
  private readonly controls = new Controls(this.state, () => this.update(), () => this.playSoon());
  private readonly prediction = new Prediction(() => this.onPredicted());
  private readonly transport = new Transport({
    toggle: () => this.toggle(),
    step: (direction) => this.goTo(this.state.impact + direction, direction),
    scrub: (progress) => this.scrub(progress),
    setRate: (rate) => { this.state.rate = this.player.rate = rate; this.remember(); },
    setSlow: (slow) => { this.state.slow = slow; this.rewarp(); this.remember(); },
  });

  private readonly sequence = new Latest<SequenceAnswer, Parameters>(
    0, (answer, parameters) => this.onSequence(answer, parameters), (error) => this.controls.setError("discrete", error));
  private readonly simulation = new Latest<SimulateAnswer, Parameters>(
    CONTINUOUS_DELAY, (answer, parameters) => this.onSimulation(answer, parameters),
    (error, parameters) => { this.refusedOf = keyOf(simulateRequest(parameters)); this.controls.setError("continuous", error); },
    (busy) => { byId("spinner").textContent = busy ? "continuous model: computing…" : ""; });
  private readonly explaining = new Latest<ExplainAnswer, null>(
    EXPLAIN_DELAY, (answer) => this.explanation.show(answer), (error) => this.explanation.say(error.message));

  constructor() {
    const { state } = this;
    goOffline(state);
    hidePanels(state);
    this.player.rate = state.rate;
    this.transport.setSettings(state.rate, state.slow, state.lock);
    setUpLayout(state, () => this.onTime());
    setUpSharing(state, () => this.syncTime(), (asks) => { if (asks) this.prediction.open(); });
    byId("csv").addEventListener("click", () => download("impacts.csv", csvOf(this.impacts())));
    if (state.predict) this.prediction.open();
    this.controls.refresh();
    this.update();
  }

  /** The situation changed. */
  private update(): void {
    const { parameters } = this.state;
    this.asked = performance.now();
    this.followsImpact = this.hasShown;
    this.sequence.ask(sequenceRequest(parameters), { ...parameters });
    this.simulation.ask(simulateRequest(parameters), { ...parameters });
    const speed = firstSpeed(parameters);
    if (speed > 0) void this.map.show(gravityNumber(parameters, speed), parameters.e);
    this.map.setAngle(parameters.angle);
    byId("map-note").hidden = parameters.body === "rod" && parameters.friction === 0;
    this.remember();
  }

  private onSequence(answer: SequenceAnswer, parameters: Parameters): void {
    this.controls.setError("discrete", null);
    const key = keyOf(simulateRequest(parameters));
    if (this.refusedOf !== key) this.controls.setError("continuous", null);
    this.answer = answer;
    this.prediction.setImpacts(answer.impacts);
    this.motions.discrete = answer.impacts.length ? new DiscreteMotion(bodyOf(parameters), answer.impacts, parameters.gravity) : null;
    if (this.continuousOf !== key) {
      // What the other model said belongs to another situation.
      this.motions.continuous = null;
      this.continuous = null;
    }
    this.showAnswers();
    document.documentElement.dataset["latency"] = (performance.now() - this.asked).toFixed(1);
  }

  private onSimulation(answer: SimulateAnswer, parameters: Parameters): void {
    this.continuousOf = keyOf(simulateRequest(parameters));
    this.controls.setError("continuous", null);
    this.continuous = answer;
    this.motions.continuous = answer.history.t.length > 1
      ? new ContinuousMotion(continuousBody(bodyOf(parameters)), answer.impacts, answer.history, parameters.gravity) : null;
    this.showAnswers();
  }

  private showAnswers(): void {
    this.scales = scalesOf(this.motions);
    this.rewarp();
    this.table.show(this.impacts(), this.state.impact);
    byId("outcome").textContent = this.answer ? outcomeInWords(this.answer.outcome) : "";
    this.force.show(this.continuous, this.motions.discrete, this.state.impact);
    this.explain();
    if (!this.player.playing) {
      // While a slider moves the picture stays with the chosen impact, whenever that is now.
      const impact = this.followsImpact ? this.steps()[this.state.impact - 1] : undefined;
      this.player.seek(impact?.start ?? this.state.time);
    }
    this.hasShown = true;
    this.onTime();
  }

  private rewarp(): void {
    const motions = [this.motions.discrete, this.motions.continuous].filter((motion) => motion !== null);
    if (!motions.length) return;
    const begin = Math.min(...motions.map((motion) => motion.begin));
    const end = Math.max(...motions.map((motion) => motion.end));
    const contacts = motions.flatMap((motion) => motion.impacts.map(({ start, duration }) => ({ start, end: start + duration })));
    this.player.setWarp(new TimeWarp(begin, end, contacts, this.state.slow));
    this.transport.setMarks(this.steps().map(({ start }) => this.player.progressAt(start)));
  }

  /** The impacts to step through: the discrete model's, or the other's if it has none. */
  private steps(): SequenceAnswer["impacts"] {
    return this.answer?.impacts ?? this.continuous?.impacts ?? [];
  }

  private impacts(): { discrete: SequenceAnswer["impacts"] | null; continuous: SequenceAnswer["impacts"] | null } {
    return { discrete: this.answer?.impacts ?? null, continuous: this.continuous?.impacts ?? null };
  }

  private onTime(): void {
    const { player, state } = this;
    const { time } = player;
    const impact = impactAt(this.steps(), time);
    if (impact && impact.n !== state.impact && player.playing) this.choose(impact.n);
    // Before the guess the picture shows the fall, not yet the blow.
    const shown = this.prediction.isOpen ? (this.motions.discrete?.begin ?? 0) : time;
    this.stage.draw(frameAt(this.motions, shown, this.scales, state.layout === "side"));
    this.numbers.show(this.motions, time);
    for (const model of ["discrete", "continuous"] as const) {
      this.energy.show(model, this.motions[model]?.energies(time) ?? null);
    }
    this.force.setTime(time);
    this.transport.show(time, player.progress, player.playing);
    this.say(impact ? impactInWords(this.steps(), impact.n) : "Falling");
    if (!player.playing) this.remember();
  }

  private say(words: string): void {
    const line = byId("caption");
    if (line.textContent !== words) line.textContent = words;
  }

  private choose(n: number): void {
    this.state.impact = n;
    this.table.choose(n);
    this.force.show(this.continuous, this.motions.discrete, n);
    this.explain();
  }

  /** To an impact; one step back from between two impacts is to the one before. */
  private goTo(n: number, direction = 0): void {
    const count = this.steps().length;
    if (!count || this.prediction.isOpen) return;
    const here = impactAt(this.steps(), this.player.time)?.n ?? 0;
    const wanted = direction === 0 ? n : here + direction;
    this.player.pause();
    clearTimeout(this.playTimer);
    this.choose(Math.min(count, Math.max(1, wanted)));
    this.player.seek(this.steps()[this.state.impact - 1]?.start ?? 0);
    this.onTime();
  }

  private scrub(progress: number): void {
    this.player.pause();
    this.followsImpact = false;
    this.player.progress = progress;
    const impact = impactAt(this.steps(), this.player.time);
    if (impact && impact.n !== this.state.impact) this.choose(impact.n);
    this.onTime();
  }

  private toggle(): void {
    if (this.prediction.isOpen) return;
    this.followsImpact = false;
    if (this.player.playing) this.player.pause();
    else this.player.play();
    this.onTime();
  }

  /** After a slider is let go the drop is played; with reduced motion only when asked for. */
  private playSoon(): void {
    clearTimeout(this.playTimer);
    if (this.prediction.isOpen || matchMedia("(prefers-reduced-motion: reduce)").matches) return;
    this.playTimer = window.setTimeout(() => {
      this.player.pause();
      this.player.progress = 0;
      this.player.play();
    }, PLAY_DELAY);
  }

  private onPredicted(): void {
    this.state.predict = false;
    byId<HTMLInputElement>("ask-first").checked = false;
    this.remember();
    this.onTime();
    this.playSoon();
    byId("play").focus();
  }

  private setAngle(angle: number): void {
    if (this.state.lock.includes("angle") || isOffline) return;
    this.state.parameters.angle = angle;
    this.controls.refresh();
    this.update();
    this.playSoon();
  }

  private explain(): void {
    if (this.state.hide.includes("explain") || !this.answer) return;
    const { parameters, impact } = this.state;
    byId("explain-title").textContent = `How impact ${impact} came about`;
    const request = explainRequest(parameters, impact);
    if (isAvailable(request)) this.explaining.ask(request, null);
    else this.explanation.say("This offline copy holds the equations of the first impacts only.");
  }

  private syncTime(): void {
    this.state.time = this.player.time;
  }

  private remember(): void {
    if (this.hasShown) this.syncTime();
    writeAddress(this.state);
  }
}

function continuousBody(body: Body): Body {
  return body.shape === "rod" && body.radius === 0 ? { ...body, radius: CONTINUOUS_RADIUS } : body;
}

new Page();
