// The page: from a change of the situation to the requests, and from their answers to the panels.
import type { ExplainAnswer } from "./answers";
import { Latest, isAvailable, isOffline } from "./api";
import { EnergyBars, ForceChart } from "./charts";
import { Controls } from "./controls";
import { byId } from "./dom";
import { Explanation } from "./explain";
import { frameAt, impactAt, scalesOf, type Scales } from "./frame";
import { AngleMap } from "./map";
import { Models } from "./models";
import { Numbers } from "./numbers";
import { goOffline, hidePanels, setUpLayout } from "./panels";
import { Player, TimeWarp } from "./playback";
import { Prediction } from "./prediction";
import { explainRequest, gravityNumber } from "./requests";
import { firstSpeed } from "./restitution";
import { setUpSharing } from "./sharing";
import { Stage } from "./stage";
import { readAddress, writeAddress, type State } from "./state";
import { ImpactTable, csvOf, download } from "./table";
import { Transport } from "./transport";
import { impactInWords, outcomeInWords } from "./words";

/** After a change, until the equations are asked for, and until the drop is played [ms]. */
const EXPLAIN_DELAY = 80;
const PLAY_DELAY = 350;

class Page {
  private readonly state: State = readAddress();
  private scales: Scales = scalesOf({ discrete: null, continuous: null });
  private asked = 0;
  /** Until the first answer the time is that of the link. */
  private hasShown = false;
  /** Whether the time is that of the chosen impact, or one that was sought. */
  private followsImpact = false;
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

  private readonly models = new Models({
    onAnswer: () => this.onAnswer(),
    onError: (model, error) => this.controls.setError(model, error),
    onBusy: (busy) => { byId("spinner").textContent = busy ? "continuous model: computing…" : ""; },
  });
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
    byId("csv").addEventListener("click", () => download("impacts.csv", csvOf(this.models.impacts)));
    if (state.predict) this.prediction.open();
    this.controls.refresh();
    this.update();
  }

  /** The situation changed. */
  private update(): void {
    const { parameters } = this.state;
    this.asked = performance.now();
    this.followsImpact = this.hasShown;
    this.models.ask(parameters);
    const speed = firstSpeed(parameters);
    if (speed > 0) void this.map.show(gravityNumber(parameters, speed), parameters.e);
    this.map.setAngle(parameters.angle);
    byId("map-note").hidden = parameters.body === "rod" && parameters.friction === 0;
    byId("numbers-note").hidden = parameters.body !== "rod";
    this.remember();
  }

  private onAnswer(): void {
    const { models } = this;
    this.scales = scalesOf(models.motions);
    this.rewarp();
    this.prediction.setImpacts(models.steps);
    this.table.show(models.impacts, this.state.impact);
    byId("outcome").textContent = models.discrete ? outcomeInWords(models.discrete.outcome) : "";
    this.force.show(models.continuous, models.motions.discrete, this.state.impact);
    this.explain();
    if (!this.player.playing) {
      // While a slider moves the picture stays with the chosen impact, whenever that is now.
      const impact = this.followsImpact || Number.isNaN(this.state.time) ? this.models.steps[this.state.impact - 1] : undefined;
      if (impact) this.state.time = impact.start;
      this.player.seek(this.state.time || 0);
    }
    this.hasShown = true;
    // The time that is wanted stays, even if it lies beyond what the first model to answer can show.
    this.draw();
    writeAddress(this.state);
    // For whoever measures how fast the page answers.
    if (!models.continuous) document.documentElement.dataset["latency"] = (performance.now() - this.asked).toFixed(1);
  }

  private rewarp(): void {
    const warp = this.models.warp(this.state.slow);
    if (!warp) return;
    this.player.setWarp(warp);
    this.transport.setMarks(this.models.steps.map(({ start }) => this.player.progressAt(start)));
  }

  /** The time moved. */
  private onTime(): void {
    const impact = impactAt(this.models.steps, this.player.time);
    if (impact && impact.n !== this.state.impact && this.player.playing) this.choose(impact.n);
    this.draw();
    if (!this.player.playing) this.remember();
  }

  private draw(): void {
    const { player, state } = this;
    const { time } = player;
    const impact = impactAt(this.models.steps, time);
    // Before the guess the picture shows the fall, not yet the blow.
    const shown = this.prediction.isOpen ? (this.models.motions.discrete?.begin ?? 0) : time;
    this.stage.draw(frameAt(this.models.motions, shown, this.scales, state.layout === "side"));
    this.numbers.show(this.models.motions, time);
    for (const model of ["discrete", "continuous"] as const) {
      this.energy.show(model, this.models.motions[model]?.energies(time) ?? null);
    }
    this.force.setTime(time);
    this.transport.show(time, player.progress, player.playing);
    say(impact ? impactInWords(this.models.steps, impact.n) : "Falling");
  }

  private choose(n: number): void {
    this.state.impact = n;
    this.table.choose(n);
    this.force.show(this.models.continuous, this.models.motions.discrete, n);
    this.explain();
  }

  /** To an impact; one step back from between two impacts is to the one before. */
  private goTo(n: number, direction = 0): void {
    const count = this.models.steps.length;
    if (!count || this.prediction.isOpen) return;
    const here = impactAt(this.models.steps, this.player.time)?.n ?? 0;
    const wanted = direction === 0 ? n : here + direction;
    this.player.pause();
    clearTimeout(this.playTimer);
    this.choose(Math.min(count, Math.max(1, wanted)));
    this.player.seek(this.models.steps[this.state.impact - 1]?.start ?? 0);
    this.onTime();
  }

  private scrub(progress: number): void {
    this.player.pause();
    this.followsImpact = false;
    this.player.progress = progress;
    const impact = impactAt(this.models.steps, this.player.time);
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
    if (this.state.hide.includes("explain") || !this.models.discrete) return;
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

/** Words that are said again would be read aloud again. */
function say(words: string): void {
  const line = byId("caption");
  if (line.textContent !== words) line.textContent = words;
}

new Page();
